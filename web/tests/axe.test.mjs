// No finding of axe on the page, light and dark: after the search on five screens, in every other state on a usual and the narrowest one.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { test } from "node:test";
import { ready } from "./browser.mjs";
import { page, type, until } from "./suite.mjs";

const source = await readFile(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const USUAL = [1280, 800];
const NARROWEST = [390, 844];
const ALL_SCREENS = [[2560, 1440], [1920, 1080], USUAL, [820, 1180], NARROWEST];

/** Findings of axe with their elements on some screens, light and dark. */
async function findings(screens) {
    await page.evaluate(source);
    const found = [];
    for (const [width, height] of screens) {
        await page.setViewportSize({ width, height });
        for (const look of ["light", "dark"]) {
            // By the page itself: a dialog may lie over the button.
            await page.evaluate((wanted) => document.documentElement.dataset.theme !== wanted && document.getElementById("theme").click(), look);
            const { violations } = await page.evaluate(() => window.axe.run());
            found.push(...violations.map(({ id, nodes }) => `${width} ${look} ${id}: ${nodes.map((node) => node.html).join(" ")}`));
        }
    }
    await page.setViewportSize({ width: 1280, height: 800 });
    return found;
}

const reset = async () => {
    if (await page.locator("#reset").isEnabled()) await page.locator("#reset").click();
    await ready(page);
};

/** States of the page: what leads to each. */
const STATES = {
    "after the search, with bifurcations and legend": async () => {
        await page.locator("details").evaluateAll((list) => list.forEach((own) => (own.open = true)));
    },
    "with a pin, a changed value and swept points": async () => {
        await page.locator("#pin").click();
        await type("stop.tip.gap", "1.1");
        await ready(page);
        await page.locator("#sweep").click();
        await until("status", /[3-9] of \d+ values computed/);
        await page.locator("#sweep").click();
        await until("status", /finished|values computed/);
    },
    "with a fault": async () => {
        await type("stop.tip.gap", "-3 kg");
        await page.locator("#control-stop-tip-gap-fault").waitFor({ state: "visible" });
    },
    "the tab of the design problem": async () => {
        await page.keyboard.press("Escape");
        await reset();
        await page.locator("#tab-design").click();
    },
    "the tab of the modes": async () => {
        await page.locator("#tab-modes").click();
        await page.locator("#mode-figures svg").first().waitFor();
    },
    "the tab of the load": async () => {
        await page.locator("#tab-load").click();
        await ready(page);
    },
    "basins, with the attractors": async () => {
        await page.locator("#tab-basins").click();
        await page.locator("#basins-starts").selectOption("225");
        await page.locator("#basins-run").click();
        await until("basins-words", /expected power/);
    },
    "the tab of the excitation, after a run": async () => {
        await page.locator("#tab-shake").click();
        await page.locator("#shake-run").click();
        await until("shake-words", /on average/);
    },
    "the dialog of the export": async () => {
        await page.locator("#tab-response").click();
        await page.locator("#export").click();
        await page.locator("#export-dialog").waitFor({ state: "visible" });
    },
};

for (const [number, [name, enter]] of Object.entries(STATES).entries()) {
    test(name, async () => {
        await enter();
        assert.deepEqual(await findings(number === 0 ? ALL_SCREENS : [USUAL, NARROWEST]), []);
    });
}

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
