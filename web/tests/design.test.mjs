// Design search: free keys, limits and tolerances, faults at their fields, the result as that of the command, Stop, the band.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFile, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { join } from "node:path";
import { test } from "node:test";
import { program, ready } from "./browser.mjs";
import { field, page, server, type, until } from "./suite.mjs";

const axeSource = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
const text = (id) => page.locator(`#${id}`).textContent();
/** A control; the group of a row has the same name. */
const label = (name) => page.getByLabel(name, { exact: true }).and(page.locator("input, select, button"));
const put = async (name, value) => label(name).fill(value);
/** Adds a row to a table of the problem. */
const add = async (what, key) => {
    await page.getByLabel(`Add a ${what}`, { exact: true }).selectOption(key);
    await label(`Add this ${what}`).click();
};
/** The command on the file of the page. */
const command = async () => {
    const path = join(server.folder, "design.toml");
    await writeFile(path, await text("search-file"));
    return spawnSync(program, ["design", path, "--json"], { encoding: "utf8", env: { ...process.env, XDG_CACHE_HOME: join(server.folder, "cache") } });
};
const overrides = () => page.evaluate(() => new URLSearchParams(location.hash.slice(1)).getAll("set").map((one) => one.split("=")));
const gapShows = (pattern) => page.waitForFunction((source) => new RegExp(source).test(document.querySelector("[aria-label='stop.tip.gap, value']").value), pattern.source);

test("the tab is reached with the arrow keys, and a key is added with the keyboard", async () => {
    await page.locator("#tab-response").focus();
    await page.keyboard.press("ArrowRight");
    assert.equal(await page.evaluate(() => document.activeElement.id), "tab-design");
    assert.ok(await page.locator("#panel-design #chart-response canvas").isVisible(), "the response is on the tab");
    await page.waitForFunction(() => document.getElementById("search-goal").options.length > 2);
    await page.getByLabel("Add a free key", { exact: true }).focus();
    await page.getByLabel("Add a free key", { exact: true }).selectOption("stop.tip.gap");
    await page.keyboard.press("Tab");
    await page.keyboard.press("Enter");
    assert.equal(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), "Stop gap, from");
    await put("Stop gap, from", "3");
    await put("Stop gap, to", "0.2");
});

test("a wrong range and a wrong limit have the messages of the command at their fields", async () => {
    await add("limit", "patch.mfc.strain");
    assert.equal(await label("Patch mfc strain, limit").inputValue(), "600 ppm");
    await put("Patch mfc strain, limit", "600 mm");
    await page.locator("#search-run").click();
    await until("search-words", /not started/);
    const messages = [await text("search-free-stop-tip-gap-fault"), await text("search-limits-patch-mfc-strain-fault")];
    assert.match(messages[0], /stop\.tip\.gap: "3 mm:0\.2 mm" is no range/);
    const { stderr, status } = await command();
    assert.notEqual(status, 0);
    for (const message of messages) assert.ok(stderr.includes(message), `${message}\n${stderr}`);
    assert.equal(await label("Stop gap, from").getAttribute("aria-invalid"), "true");
    assert.equal(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), "Stop gap, from");
    await put("Stop gap, from", "0.2");
    await put("Stop gap, to", "3");
    await put("Patch mfc strain, limit", "600");
    await put("starts", "many");
    // Enter accepts the value; the search begins with its button.
    await page.keyboard.press("Enter");
    assert.equal(await page.locator("#search-run").textContent(), "Start");
    assert.ok(await page.locator("#search-goal-fault").isHidden());
    await page.locator("#search-run").click();
    await until("search-goal-fault", /goal\.starts is "many"; it must be a whole number/);
    assert.ok(await page.locator("#search-free-stop-tip-gap-fault").isHidden());
    await put("starts", "10");
});

test("the search ends with the design of the command, and undo leads back", async () => {
    await add("free key", "circuit.load.resistance");
    await put("Circuit resistance, from", "0.01");
    await put("Circuit resistance, to", "3");
    await put("designs, at most", "300");
    await page.locator("#search-run").click();
    await until("search-words", /designs evaluated/);
    await page.waitForFunction(() => document.querySelector("[aria-label='stop.tip.gap, value']").value !== "1");
    assert.ok(await page.locator("#search-take").isDisabled());
    await until("search-words", /^finished$/);
    const due = JSON.parse((await command()).stdout);
    const shown = await text("search-result");
    const power = (watt) => `${Number((1e3 * watt).toPrecision(4))} mW`;
    assert.ok(shown.includes(power(due.best.expected_power_w)), `${power(due.best.expected_power_w)}\n${shown}`);
    assert.match(shown, /Stop gap1 mm0?\.?\d/);
    assert.match(shown, /Limits.*patch mfc strain.*ppmat most 600 ppm(binds|does not bind)/);
    assert.match(shown, /reached by [\d.]+ % of the starts/);
    assert.ok(shown.includes(`${due.evaluations} evaluations in`));
    assert.match(await text("readout"), /Pale: the start of the design search/);
    await page.locator("#search-take").click();
    await page.waitForFunction(() => location.hash.includes("stop.tip.gap") && !document.getElementById("undo").disabled);
    for (const [key, value] of await overrides()) {
        const inSi = (text) => {
            const [number, unit] = text.split(" ");
            return Number(number) * { mm: 1e-3, ohm: 1, kohm: 1e3, Mohm: 1e6 }[unit];
        };
        assert.ok(Math.abs(inSi(value) / inSi(due.best.set[key]) - 1) < 1e-12, `${key} ${value} ${due.best.set[key]}`);
    }
    await ready(page);
    // What the page computes at the design, from its own starts, is what the search says.
    await until("operating-words", /reached by .* of 100 starts/);
    assert.ok((await text("operating-words")).includes(power(due.best.mean_power_w).slice(0, 5)), await text("operating-words"));
    await page.locator("#undo").click();
    await gapShows(/^1$/);
    assert.ok(await page.locator("#search-stale").isVisible());
    await page.locator("#redo").click();
    await page.locator("#search-stale").waitFor({ state: "hidden" });
    await page.locator("#search-back").click();
    await gapShows(/^1$/);
    await ready(page);
});

test("Stop ends the search with the best design so far, and so does a change by hand", async () => {
    await put("designs, at most", "100000");
    await put("starts", "100");
    await page.locator("#search-run").click();
    await page.waitForFunction(() => document.querySelector("[aria-label='stop.tip.gap, value']").value !== "1");
    await page.locator("#search-run").click();
    await until("search-words", /^stopped; this is the best design so far/);
    assert.match(await text("search-result"), /Best design so far.*Limits/);
    assert.equal(await text("search-run"), "Start");
    await page.keyboard.press("Control+z");
    await gapShows(/^1$/);
    await ready(page);
    await page.locator("#search-run").click();
    await until("search-words", /designs evaluated/);
    await type("circuit.load.resistance", "2");
    await until("search-words", /because the design has changed/);
    await page.locator("#reset").click();
    await ready(page);
});

test("a limit that no design keeps is not met, in the colour of warnings", async () => {
    await put("Patch mfc strain, limit", "1");
    await put("designs, at most", "40");
    await page.locator("#search-run").click();
    await until("search-words", /^finished; no design keeps all limits$/);
    const state = page.locator("#search-result td.warning");
    assert.deepEqual(await state.allTextContents(), ["not met"]);
    assert.doesNotMatch(await page.locator("#search-result table").last().textContent(), /bind/);
    const [own, due] = await Promise.all([state, page.locator("#search-stale")].map((one) => one.evaluate((element) => getComputedStyle(element).color)));
    assert.equal(own, due);
    await put("Patch mfc strain, limit", "600");
    await put("designs, at most", "300");
    await page.locator("#search-back").click();
    await gapShows(/^1$/);
    await ready(page);
});

test("robust shades the band of the power, and a wrong tolerance has a message at its field", async () => {
    const canvas = page.locator("#chart-response canvas");
    const before = await canvas.evaluate((own) => own.toDataURL());
    await page.locator("#robust").check();
    await until("search-tolerance", /no tolerance is given/);
    await add("tolerance", "stop.tip.gap");
    await put("Stop gap, tolerance", "-0.05");
    await page.keyboard.press("Enter");
    await until("search-tolerance-stop-tip-gap-fault", /stop\.tip\.gap: "-0\.05 mm" is no tolerance; it must be above 0/);
    await put("Stop gap, tolerance", "0.05");
    await page.keyboard.press("Enter");
    await until("robust-words", /shaded: 5 % to 95 % of 64 drawn designs/);
    assert.ok(await page.locator("#search-tolerance-stop-tip-gap-fault").isHidden());
    assert.notEqual(await canvas.evaluate((own) => own.toDataURL()), before);
    await until("readout", /Shaded: 5 % to 95 %/);
    // The band follows the design.
    await type("stop.tip.gap", "1.1");
    await page.waitForFunction(() => !/shaded/.test(document.getElementById("robust-words").textContent));
    await until("robust-words", /shaded/);
    await page.locator("#robust").uncheck();
    await until("robust-words", /^$/);
    await page.locator("#reset").click();
    await ready(page);
    assert.equal(await field("stop.tip.gap").inputValue(), "1");
});

test("the problem is there again after a reload", async () => {
    await page.locator("#search-goal").selectOption({ index: 1 });
    await put("seed", "7");
    await label("Stop gap, logarithmic").check();
    await label("Stop gap, normal distribution").check();
    await page.locator("#robust").check();
    const state = () => page.locator("#search-form").evaluate((form) => [...form.querySelectorAll("input, #search-goal")].map((own) => [own.ariaLabel ?? own.id, own.value, own.checked]));
    const before = await state();
    assert.ok(before.length > 12, JSON.stringify(before));
    await page.reload();
    await ready(page);
    await page.locator("#tab-design").click();
    await label("Patch mfc strain, limit").waitFor();
    assert.deepEqual(await state(), before);
    await until("robust-words", /shaded: 5 % to 95 % of 64 drawn designs/);
    await page.locator("#robust").uncheck();
    await page.locator("#search-goal").selectOption({ index: 0 });
});

test("a row is removed, and nothing free is a fault", async () => {
    await label("Remove Stop gap, free key").click();
    await label("Remove Circuit resistance, free key").click();
    await page.locator("#search-run").click();
    await until("search-free", /free names no key/);
    await page.locator("#tab-response").click();
    assert.ok(await page.locator("#panel-response #chart-response canvas").isVisible(), "the chart is back");
    await page.locator("#tab-design").click();
});

test("axe has no finding on the tab, in light and dark and on a narrow screen", async () => {
    await ready(page);
    for (const [look, width] of [["light", 1280], ["dark", 1280], ["dark", 390]]) {
        await page.setViewportSize({ width, height: 800 });
        if ((await page.evaluate(() => document.documentElement.dataset.theme)) !== look) await page.locator("#theme").click();
        await page.evaluate(await readFile(axeSource, "utf8"));
        const { violations } = await page.evaluate(() => window.axe.run("#response"));
        assert.deepEqual(violations.map((own) => [own.id, own.nodes.map((node) => node.html)]), [], `${look} ${width}`);
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `nothing overflows at ${width} px`);
    }
    await page.setViewportSize({ width: 1280, height: 800 });
});

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
