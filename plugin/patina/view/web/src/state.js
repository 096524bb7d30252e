// SPDX-License-Identifier: Apache-2.0
// The user's changes, and how they become a link. Values of inputs are arrays of numbers.

const copy = x => JSON.parse(JSON.stringify(x));

// Links are written by anyone. Shaders have single precision, in which a large number is infinite.
const isNumber = x => typeof x === "number" && Number.isFinite(Math.fround(x));
const fits = (a, b) => Array.isArray(b) ? Array.isArray(a) && a.length === b.length && a.every(isNumber)
    : typeof b === "number" ? isNumber(a) : typeof a === typeof b;
const listOf = x => Array.isArray(x) ? x : [];

// What an object has for places of a list: of its keys those that are whole numbers below the length.
const forPlaces = (object, list) => Object.entries(typeof object === "object" && object ? object : {})
    .map(([key, value]) => [Number(key), value, key])
    .filter(([i, , key]) => String(i) === key && Number.isInteger(i) && i >= 0 && i < list.length);

// The program that a material has for its choices; undefined where it has none.
const placeOf = ({ places }, choices) => {
    const key = choices.join();
    return Object.hasOwn(places, key) ? places[key] : undefined;
};

export class State {
    constructor(data) {
        this.data = data;
        this.reset();
    }

    reset() {
        const { data } = this, start = data.start;
        Object.assign(this, copy(start));
        this.values = data.materials.map(m => m.inputs.map(i => i.value.slice()));
        this.choices = data.materials.map(m => m.choices.map(c => c.at));
        this.lights = data.lights.map(() => ({ on: true, gain: 1, color: [1, 1, 1] }));
        this.methods = data.materials.map(() => null); // { point, name } of one that is not the plan's
        this.whole = false; // the text with every input, though none needs it
        this.wedge = null;
        this.wipe = 1;
    }

    get current() { return this.data.materials[this.material]; }

    // Which of the material's programs has the method or the choices that were made.
    get program() {
        return this.programOf(this.methods[this.material]) ??
            placeOf(this.current, this.choices[this.material]) ?? 0;
    }

    programOf(method) {
        const point = this.current.plan.choices.find(c => c.point === method?.point);
        return point?.methods.find(m => m.name === method.name)?.program ?? null;
    }

    // Draws with a method that has a program, or (null) with those of the plan. Its program has the
    // authored choices.
    useMethod(method) {
        this.methods[this.material] = this.programOf(method) === null ? null : method;
        if (this.methods[this.material]) this.choices[this.material] = this.current.choices.map(c => c.at);
    }

    // Where no program was made for what is chosen together, this choice stands alone.
    // @returns whether others had to go back to where they were authored
    choose(index, at) {
        const { current, material } = this, start = current.choices.map(c => c.at);
        this.methods[material] = null;
        const together = this.choices[material].map((old, i) => i === index ? at : old);
        const alone = start.map((old, i) => i === index ? at : old);
        const known = list => placeOf(current, list) !== undefined;
        this.choices[material] = known(together) ? together : known(alone) ? alone : start;
        return !known(together);
    }

    // Whether some value has left the authored one that only the whole program can follow.
    needsAll() {
        const m = this.current, { lean } = m.programs[this.program];
        const changed = this.values[this.material].some((v, i) =>
            !lean.live.includes(i) && String(v) !== String(m.inputs[i].value));
        return this.whole || changed || Boolean(this.wedge && !lean.live.includes(this.wedge.input));
    }

    // A narrow picture keeps the width in view.
    fieldOfView(aspect) {
        const half = Math.tan(this.data.camera.fov * Math.PI / 360);
        return 2 * Math.atan(aspect < 1 ? half / aspect : half) * 180 / Math.PI;
    }

    // Whether light, place and values are those of the start, for which there may be a path-traced one.
    isAtStart() {
        const fresh = new State(this.data);
        const same = key => JSON.stringify(this[key]) === JSON.stringify(fresh[key]);
        return ["environment", "rotation", "environmentGain", "ambient", "backdrop", "lights", "wedge"]
            .every(same) && this.eye.every((x, i) => Math.abs(x - fresh.eye[i]) < 1e-4 * this.data.camera.radius) &&
            String(this.values[this.material]) === String(fresh.values[this.material]) &&
            String(this.choices[this.material]) === String(fresh.choices[this.material]);
    }

    // Only what differs from the start.
    toText() {
        const fresh = new State(this.data), out = {};
        const values = {};
        this.values.forEach((list, m) => list.forEach((v, i) => {
            if (String(v) !== String(fresh.values[m][i])) (values[m] ??= {})[i] = v;
        }));
        if (Object.keys(values).length) out.values = values;
        if (String(this.choices) !== String(fresh.choices)) out.choices = this.choices;
        for (const key of [...Object.keys(this.data.start), "lights", "wedge", "methods", "whole"])
            if (JSON.stringify(this[key]) !== JSON.stringify(fresh[key])) out[key] = this[key];
        return Object.keys(out).length ? encodeURIComponent(JSON.stringify(out)) : "";
    }

    // @returns whether the text was one of this page's links; what does not fit is left out
    fromText(text) {
        let read;
        try { read = JSON.parse(decodeURIComponent(text)); } catch { return false; }
        if (typeof read !== "object" || read === null || Array.isArray(read)) return false;
        for (const [m, list] of forPlaces(read.values, this.values))
            for (const [i, v] of forPlaces(list, this.values[m]))
                if (fits(v, this.values[m][i])) this.values[m][i] = v;
        listOf(read.choices).slice(0, this.choices.length).forEach((list, m) => {
            const picked = listOf(list);
            if (picked.every(Number.isInteger) && placeOf(this.data.materials[m], picked) !== undefined)
                this.choices[m] = picked;
        });
        for (const key of Object.keys(this.data.start))
            if (Object.hasOwn(read, key) && fits(read[key], this[key])) this[key] = read[key];
        const clamped = (x, n) => Number.isInteger(x) && x >= 0 && x < n ? x : 0;
        this.material = clamped(this.material, this.data.materials.length);
        this.shape = clamped(this.shape, this.data.shapes.length);
        this.environment = clamped(this.environment, this.data.environments.length);
        this.samples = Math.min(1024, Math.max(4, Math.round(this.samples) || 64));
        this.whole = read.whole === true;
        listOf(read.methods).forEach((method, m) => {
            const plan = this.data.materials[m]?.plan.choices.find(c => c.point === method?.point);
            const known = plan?.methods.find(x => x.name === method.name && x.program !== null);
            if (!known) return;
            this.methods[m] = { point: plan.point, name: known.name };
            this.choices[m] = this.data.materials[m].choices.map(c => c.at);
        });
        const w = read.wedge;
        if (w && Number.isInteger(w.input) && this.current.inputs[w.input] && [w.from, w.to].every(isNumber) &&
            Number.isInteger(w.count) && w.count >= 1 && w.count <= 9) {
            const component = Number.isInteger(w.component) ? w.component : 0;
            this.wedge = { input: w.input, component, from: w.from, to: w.to, count: w.count };
        }
        listOf(read.lights).forEach((l, i) => {
            if (this.lights[i] && isNumber(l?.gain) && fits(l.color, [1, 1, 1]))
                this.lights[i] = { on: Boolean(l.on), gain: l.gain, color: l.color };
        });
        return true;
    }
}
