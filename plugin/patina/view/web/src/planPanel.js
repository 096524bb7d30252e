// SPDX-License-Identifier: Apache-2.0
// What the plan of the material keeps and leaves out, and what the methods would change that it has not
// taken.
import { differencePicture, luminance, measureChange, percent, relative } from "./change.js";
import { element } from "./element.js";

const short = x => x === null || x === undefined ? "\u2013" : x === 0 ? "0" : Number(x.toPrecision(2)).toString();
const list = (lines, id) => element("ul", { id }, ...lines.map(line => element("li", {}, element("code", {}, line))));

export class PlanPanel {
    constructor(page) {
        this.page = page;
        this.box = element("div", { className: "plan" });
        this.material = -1;
    }

    get title() { return `Plan of ${this.page.state.current.name}`; }

    refresh() {
        const { state } = this.page;
        if (this.material !== state.material) this.build();
        const now = state.methods[state.material];
        for (const [button, method] of this.buttons)
            button.setAttribute("aria-pressed", String(now ? now.point === method.point && now.name === method.name : method.own));
        for (const [button, input, to] of this.moves)
            button.setAttribute("aria-pressed", String(String(state.values[state.material][input]) === String(to)));
        if (this.cuts) this.cuts.setAttribute("aria-pressed", String(state.whole));
    }

    build() {
        const { state } = this.page, { plan, notes, programs } = state.current;
        this.material = state.material;
        this.buttons = [];
        this.moves = [];
        this.readout = element("p", { id: "planState", role: "status" });
        this.picture = element("div", { id: "planPicture" });
        this.cuts = plan.leftOut.length && programs[0].whole ? element("button", { type: "button", id: "planCuts",
            onclick: () => this.drawCuts() }, "draw with every input live") : null;
        this.box.replaceChildren(
            element("div", { className: "result" }, this.readout, this.picture),
            element("p", {}, "The plan, its predicted errors and albedos are of the values as authored. Choose a method and the page " +
                "draws with it, and measures the picture that it shows."),
            element("h3", {}, "Methods"), this.table(plan),
            element("h3", {}, "Kept"), list(plan.kept, "planKept"),
            element("h3", {}, "Left out"),
            plan.leftOut.length ? list(plan.leftOut, "planLeftOut") : element("p", { id: "planLeftOut" }, "Nothing."),
            plan.leftOut.length ? element("p", {}, "What has no weight or is black changes nothing while its inputs stay as authored. ",
                                          this.cuts) : null,
            plan.effects.length ? this.effects(plan) : null,
            notes.length ? element("h3", {}, "Not shown by this page") : null,
            notes.length ? list(notes, "planNotes") : null);
    }

    table(plan) {
        const heads = ["method", "predicted error", "time", "albedo", "change of it", ""];
        const table = element("table", {}, element("caption", {}, "Errors are of relative luminance against the exact method, over " +
            "all bounces between surfaces like this; times are over the default method's; albedo is the luminance that the " +
            "material sends on in even light of 1, of samples."),
            element("thead", {}, element("tr", {}, ...heads.map(text => text ? element("th", { scope: "col" }, text)
                                                                            : element("td", {})))));
        for (const choice of plan.choices) {
            const head = element("tr", {}, element("th", { scope: "rowgroup", colSpan: heads.length }, choice.point));
            table.append(element("tbody", { className: "point" }, head,
                                 ...choice.methods.map(method => this.row(plan, choice, method))));
        }
        return table;
    }

    // Inputs that would bring more lobes.
    effects(plan) {
        const { page } = this, { state } = page, { inputs } = state.current, heads = ["input", "now", "to", "albedo", "change of it"];
        const cell = text => element("td", { className: "number" }, text), numbers = v => v.map(short).join(" ");
        const body = element("tbody", {}, ...plan.effects.map(({ input, to, albedo }) => {
            const { input: name, value } = inputs[input];
            const button = element("button", { type: "button", "aria-label": `draw: ${name} ${numbers(to)}`,
                                               onclick: () => this.move(input, to) }, "draw");
            this.moves.push([button, input, to]);
            return element("tr", {}, element("th", { scope: "row" }, element("code", {}, name)), cell(numbers(value)), cell(numbers(to)),
                           cell(albedo ? luminance(albedo).toFixed(3) : "\u2013"),
                           cell(albedo && plan.albedo ? percent(relative(plan.albedo, albedo)) : "\u2013"), element("td", {}, button));
        }));
        return element("table", { id: "planEffects" }, element("caption", {}, "Inputs at which the plan would keep more: the albedo " +
            "at the end of the range that is farther from the authored value."),
            element("thead", {}, element("tr", {}, ...heads.map(text => element("th", { scope: "col" }, text)), element("td", {}))), body);
    }

    // Moves an input to a value, or back to the authored one.
    async move(input, to) {
        const { page } = this, { state } = page, values = state.values[state.material], { inputs } = state.current;
        const start = inputs[input].value;
        if (String(values[input]) === String(to)) {
            values[input] = start.slice();
            page.refresh();
            return this.say("The input is as it was authored.");
        }
        return this.measure(() => { values[input] = start.slice(); }, () => { values[input] = to.slice(); },
                            `${inputs[input].input} at ${to.map(short).join(" ")}`, "");
    }

    row(plan, choice, method) {
        const own = method.name === choice.method, cell = text => element("td", { className: "number" }, text);
        const albedo = method.albedo && luminance(method.albedo);
        const change = own || !method.albedo || !plan.albedo ? "\u2013" : percent(relative(plan.albedo, method.albedo));
        let action = method.why;
        if (own || method.program !== null) {
            const word = own ? "as planned" : "draw";
            action = element("button", { type: "button", "aria-label": `${word}: ${choice.point} ${method.name}`,
                                         onclick: () => this.use(choice, method) }, word);
            this.buttons.push([action, { point: choice.point, name: method.name, own }]);
        }
        return element("tr", {}, element("th", { scope: "row", title: method.text }, method.name, element("small", {}, method.text)),
                       cell(short(method.error)), cell(method.time === null ? "\u2013" : short(method.time) + "\u00d7"),
                       cell(method.albedo ? albedo.toFixed(3) : "\u2013"), cell(change), element("td", {}, action));
    }

    // Draws with a method, and tells what it changes.
    async use(choice, method) {
        const { page } = this, { state } = page, own = method.name === choice.method;
        if (own) {
            state.useMethod(null);
            page.refresh();
            return this.say("The page draws with the methods of the plan.");
        }
        const { albedo } = state.current.plan;
        const more = (albedo && method.albedo ? `; in even light by ${percent(relative(albedo, method.albedo))}` : "") +
            (method.error === null ? "" : `; predicted error ${short(method.error)}`);
        return this.measure(() => state.useMethod(null), () => state.useMethod({ point: choice.point, name: method.name }),
                            `${choice.point} ${method.name} instead of ${choice.method}`, more);
    }

    async drawCuts() {
        const { page } = this, { state } = page;
        if (state.whole) {
            state.whole = false;
            page.refresh();
            return this.say("The page draws with what the plan kept.");
        }
        return this.measure(() => { state.whole = false; }, () => { state.whole = true; }, "every input live", "");
    }

    async measure(without, now, what, more) {
        if (this.busy) return null;
        this.busy = true;
        this.say("Compiling and measuring ...");
        await new Promise(done => setTimeout(done, 30));
        try {
            const found = await measureChange(this.page, without, now);
            const means = found.before && found.after ? `the shape's mean luminance changes by ${percent(relative(found.before,
                found.after))}` : "the shape is not in view";
            this.say(`With ${what} ${means}, mean FLIP ${found.flip.toFixed(4)}${more}.`);
            this.picture.replaceChildren(differencePicture(found, 2 ** this.page.state.exposure));
            return found;
        } finally {
            this.busy = false;
            this.page.refresh();
        }
    }

    say(text) {
        this.readout.textContent = text;
        this.picture.replaceChildren();
    }
}
