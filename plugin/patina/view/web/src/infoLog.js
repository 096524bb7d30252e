// SPDX-License-Identifier: Apache-2.0
// Compilers tell errors in their own words; WebGL hands them on.

const forms = [
    /^(ERROR|WARNING):\s*\d+:(\d+):\s*(.*)$/i,              // ANGLE, which most browsers have
    /^\d+:(\d+)\(\d+\):\s*(error|warning):\s*(.*)$/i,       // Mesa
    /^\d+\((\d+)\)\s*:\s*(error|warning)\s*(?:\w+:)?\s*(.*)$/i // NVIDIA
];

// @returns list of { line, isError, text }; line is of the compiled text, from 1, or null where the log has none
export function readLog(log) {
    const found = [];
    for (const row of (log ?? "").replace(/\0/g, "").split("\n").map(r => r.trim()).filter(Boolean)) {
        const at = forms.findIndex(form => form.test(row));
        if (at < 0) {
            found.push({ line: null, isError: !/^warning/i.test(row), text: row });
            continue;
        }
        const [, a, b, text] = forms[at].exec(row), [line, kind] = at === 0 ? [b, a] : [a, b];
        found.push({ line: Number(line), isError: /error/i.test(kind), text });
    }
    return found;
}
