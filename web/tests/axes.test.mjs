// Axes of charts: values with a label, with the cases of the pictures of the program, and the unit of the numbers.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { build } from "esbuild";

const load = async (name) => {
    const { outputFiles: [{ text }] } = await build({ entryPoints: [new URL(`../src/${name}.ts`, import.meta.url).pathname], bundle: true, format: "esm", write: false });
    return import(`data:text/javascript,${encodeURIComponent(text)}`);
};
const { logLabels } = await load("ticks");
const { axisUnit, logAxisUnit, printed, scientific } = await load("units");

/** Cases of the pictures of the program. */
const cases = JSON.parse(await readFile(new URL("../../crates/jounce-plot/src/axis/cases.json", import.meta.url)));

test("a logarithmic axis has the labels of the pictures of the program", () => {
    for (const { low, high, nearest, labels } of cases.labels) {
        const found = logLabels(low, high, nearest);
        assert.ok(found.length === labels.length && found.every((value, k) => Math.abs(value / labels[k] - 1) < 1e-9), `${low} to ${high}, ${nearest}: ${found}`);
    }
});

test("a logarithmic axis has the unit of the pictures of the program", () => {
    for (const { low, high, unit, shown } of cases.units) assert.equal(logAxisUnit(low, high, unit)[1], shown, `${low} to ${high} ${unit}`);
});

test("every logarithmic axis has at least two labels, and all labels of a pattern", () => {
    for (let k = 0; k < 2000; k++) {
        const low = 10 ** (-6 + 8 * ((k * 0.618) % 1));
        const high = low * 10 ** (0.02 + 6 * ((k * 0.414) % 1));
        const nearest = 0.05 + 0.6 * ((k * 0.236) % 1);
        const found = logLabels(low, high, nearest);
        assert.ok(found.length >= 2 && found.every((value) => value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9)), `${low} to ${high}, ${nearest}: ${found}`);
        if (found.length < 3) continue;
        const ratios = found.slice(1).map((value, own) => Math.log10(value / found[own]));
        const steps = found.slice(1).map((value, own) => value - found[own]);
        const same = (values) => values.every((value) => Math.abs(value / values[0] - 1) < 1e-6);
        const cycle = ratios.every((value, own) => Math.abs(value + (ratios[own + 1] ?? 0) + (ratios[own + 2] ?? 0) - 1) < 1e-6 || own + 2 >= ratios.length);
        assert.ok(same(ratios) || same(steps) || cycle, `${low} to ${high}, ${nearest}: ${found}`);
    }
});

test("the larger end of an axis, also a negative one, gives the unit", () => {
    for (const [low, high, unit, shown] of [
        [-3e-3, 1.2e-5, "m", "mm"], [-4e-5, 0, "m", "µm"], [-2e-9, -1e-9, "m", "nm"], [0, 2e-5, "m", "µm"], [-0.3, 0.3, "V", "mV"],
        [0, 1000, "Hz", "Hz"], [0, 5000, "Hz", "kHz"], [-5e-4, 5e-4, "m/s", "µm/s"], [0, 1e-6, "kg", "kg"], [0, 1e-5, "V^2/Hz", "V²/Hz"],
    ]) assert.equal(axisUnit(low, high, unit)[1], shown, `${low} to ${high}`);
});

test("a logarithmic axis of many decades has powers of ten, without a prefix", () => {
    assert.deepEqual(logAxisUnit(1e-5, 1e-2, "W"), [1e-6, "µW"]);
    assert.deepEqual(logAxisUnit(1e-9, 1e-2, "W"), [1, "W"]);
    assert.deepEqual([1e-5, 2e-5, 1e6].map(scientific), ["10⁻⁵", "2×10⁻⁵", "10⁶"]);
});

test("a message has its units as they are set in print", () => {
    assert.equal(printed("a contact lasts 629 us; 5 kohm, 20 ohm, 30 um under use"), "a contact lasts 629 µs; 5 kΩ, 20 Ω, 30 µm under use");
});
