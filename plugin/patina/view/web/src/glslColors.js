// SPDX-License-Identifier: Apache-2.0
// The words of a line of GLSL by their kind, for the editor.

const words = /\/\/.*|\/\*.*?(?:\*\/|$)|^\s*#\s*\w+|\b\d[\w.]*|\.\d[\w]*|[A-Za-z_]\w*/g;
const keywords = new Set(("if else for while do switch case default return break continue discard struct const in out inout " +
    "uniform precision highp mediump lowp flat smooth layout true false").split(" "));
const type = /^(void|bool|u?int|float|[biu]?vec[234]|mat[234](x[234])?|[iu]?sampler(2D|3D|Cube)\w*)$/;

function kindOf(word) {
    if (word[0] === "/") return "comment";
    if (word.trimStart()[0] === "#") return "directive";
    if (/^[.\d]/.test(word)) return "number";
    return keywords.has(word) || type.test(word) ? "keyword" : "";
}

// @param inComment whether the line begins inside of a comment
// @returns list of [text, kind]; kind is "" for what has no colour
export function colored(line, inComment) {
    const out = [];
    let at = 0;
    if (inComment) {
        const end = line.indexOf("*/");
        at = end < 0 ? line.length : end + 2;
        out.push([line.slice(0, at), "comment"]);
    }
    const rest = line.slice(at);
    let done = 0;
    for (const match of rest.matchAll(words)) {
        const kind = kindOf(match[0]);
        if (!kind) continue;
        if (match.index > done) out.push([rest.slice(done, match.index), ""]);
        out.push([match[0], kind]);
        done = match.index + match[0].length;
    }
    out.push([rest.slice(done), ""]);
    return out;
}
