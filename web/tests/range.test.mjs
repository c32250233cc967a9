// The range of the response: keys in the order of the sliders, and a wider range at a click.
import assert from "node:assert/strict";
import { test } from "node:test";
import { ready } from "./browser.mjs";
import { page, type, until } from "./suite.mjs";

const ends = async () => [await page.locator("#from").inputValue(), await page.locator("#to").inputValue()].map(Number);

test("keys of the stop, the circuit and the drive come first", async () => {
    const keys = await page.locator("#over option").evaluateAll((options) => options.map(({ value }) => value));
    const open = keys.map((key) => /^(stop|circuit|drive)\./.test(key));
    assert.ok(open[0] && open.lastIndexOf(true) < open.indexOf(false), keys.join());
    const words = await page.locator("#over option").allTextContents();
    assert.ok(words.includes("Stop gap") && words.includes("Beam length"), words.join());
});

test("where must the gap be so that 12 Hz is safe: the ranges with one stable orbit, after two clicks", async () => {
    await type("drive.shaker.frequency", "12");
    await page.locator("#over").selectOption("stop.tip.gap");
    await ready(page);
    assert.deepEqual(await ends(), [0.5, 1.5]);
    await until("readout", /^Stable orbits found: 1 in the complete range\./);
    for (const [from, to] of [[0.28868, 2.5981], [0.096225, 7.7942]]) {
        await page.locator("#widen").click();
        assert.deepEqual(await ends(), [from, to]);
    }
    await ready(page);
    await until("readout", /^Stable orbits found: 1 up to 5\.\d+ mm, .*, then 2\./);
});

test("a range with an end at 0 or below gets twice its width", async () => {
    await page.locator("#from").fill("0");
    await page.locator("#to").fill("2");
    await page.locator("#to").press("Enter");
    await page.locator("#over").selectOption("drive.shaker.phase");
    await page.locator("#from").fill("-1");
    await page.locator("#to").fill("1");
    await page.locator("#to").press("Enter");
    await page.locator("#widen").click();
    assert.deepEqual(await ends(), [-2, 2]);
});

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
