// The comparison of a draft with its result, on curves whose difference is known.
import assert from "node:assert/strict";
import { test } from "node:test";
import { build } from "esbuild";

const source = new URL("../src/draft-error.ts", import.meta.url).pathname;
const { outputFiles: [{ text }] } = await build({ entryPoints: [source], bundle: true, format: "esm", write: false });
const { draftError, errorWords } = await import(`data:text/javascript,${encodeURIComponent(text)}`);

/** A response of one branch over 0 to 1, without a draft. */
const response = (power) => {
    const x = Array.from({ length: 11 }, (_, k) => k / 10);
    return { branches: [{ period: 1, x, values: { power: x.map(power) }, error: x.map(() => 0) }] };
};

test("a difference of a power is that of the curve", () => {
    const found = draftError(response((x) => 1 + x), response((x) => 1.02 * (1 + x)), 1);
    assert.ok(Math.abs(Math.expm1(found.farthest / 0.2) - 0.02) < 2e-3, JSON.stringify(found));
});

test("a power that is practically 0 does not make a draft wrong", () => {
    const rectified = (tail) => (x) => (x < 0.45 ? 1e-3 * (1 - x) : tail(x));
    const found = draftError(response(rectified((x) => 1e-22 * x)), response(rectified((x) => 1e-15 / x)), 1);
    assert.ok(found.farthest < 1e-12 && found.off === 0 && found.missing === 0, `${JSON.stringify(found)} ${errorWords(found)}`);
    assert.equal(draftError(response(() => 0), response(() => 0), 1), undefined);
});
