// SPDX-License-Identifier: Apache-2.0
// Changed values as a layer of USD, over the file that holds the material or, where that is no
// stage, with the whole material in it. Names come from the file and are checked again here.

const types = { boolean: "bool", integer: "int", string: "string", float: "float", vector2: "float2", vector3: "float3", vector4: "float4", color3: "color3f",
                color4: "color4f" };
const number = x => Number.isFinite(x) ? String(Number(x.toPrecision(9))) : "0";
// OpenUSD refuses a layer in which a boolean or an integer is anything else; links and sliders may bring it.
const texts = { boolean: x => x ? "1" : "0",
                integer: x => String(Math.min(2147483647, Math.max(-2147483648, Math.round(x) || 0))) };
const valueText = (v, kind) => {
    const all = v.map(texts[kind] ?? number);
    return all.length === 1 ? all[0] : `(${all.join(", ")})`;
};
const quoted = text => `"${text.replace(/[\x00-\x1f]/g, " ").replace(/\\/g, "\\\\").replace(/"/g, '\\"')}"`;
const isPath = path => /^(\/[A-Za-z_]\w*)+$/.test(path);
const isName = name => /^[A-Za-z_]\w*(:[A-Za-z_]\w*)*$/.test(name);

function print(tree, indent) {
    let text = "";
    for (const [name, node] of Object.entries(tree)) {
        text += `${indent}${node.spec ?? "over"} "${name}"\n${indent}{\n`;
        for (const line of node.lines) text += `${indent}    ${line}\n`;
        text += print(node.children, indent + "    ") + `${indent}}\n`;
    }
    return text;
}

// Trees have no prototype: a prim may be called __proto__.
function nodeAt(tree, path) {
    let children = tree, node = null;
    for (const name of path.slice(1).split("/")) {
        node = children[name] ??= { lines: [], children: Object.create(null) };
        children = node.children;
    }
    return node;
}

export function layerText(state) {
    const { current: material, material: m } = state, { layer } = material, tree = Object.create(null);
    const whole = layer.prims.length > 0;
    for (const prim of layer.prims)
        if (isPath(prim.path)) Object.assign(nodeAt(tree, prim.path), { spec: prim.spec, lines: prim.lines.slice() });
    material.inputs.forEach((input, i) => {
        const dot = input.input.lastIndexOf(".");
        const path = (layer.paths[input.input.slice(0, dot)] ?? input.input.slice(0, dot));
        const name = input.input.slice(dot + 1), value = state.values[m][i];
        if (!isPath(path) || !isName(name)) return;
        if (!whole && String(value) === String(input.value)) return;
        const node = nodeAt(tree, path), declared = `${types[input.kind]} inputs:${name}`;
        // The author's value may have a colour space; the page's are linear.
        const space = !whole && input.kind.startsWith("color") ? ' (colorSpace = "lin_rec709_scene")' : "";
        node.lines.push(`${declared} = ${valueText(value, input.kind)}${space}`);
        if (!whole) node.lines.push(`${declared}.connect = None`);
    });
    material.choices.forEach((choice, i) => {
        const dot = choice.input.lastIndexOf("."), at = state.choices[m][i];
        const path = layer.paths[choice.input.slice(0, dot)] ?? choice.input.slice(0, dot);
        const name = choice.input.slice(dot + 1), value = choice.values[at];
        if (!isPath(path) || !isName(name) || (!whole && at === choice.at)) return;
        const text = choice.kind === "string" ? quoted(String(value)) : number(Number(value));
        nodeAt(tree, path).lines.push(`${types[choice.kind]} inputs:${name} = ${text}`);
    });
    const sub = layer.asset ? `    subLayers = [\n        ${layer.asset}\n    ]\n` : "";
    const lead = layer.defaultPrim && isName(layer.defaultPrim) ? `    defaultPrim = "${layer.defaultPrim}"\n` : "";
    return `#usda 1.0\n(\n${lead}${sub})\n\n${print(tree, "")}`;
}
