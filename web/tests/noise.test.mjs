// A spec under noise: mean power with its interval, warnings, tabs that cannot work; peaks and warnings of orbits; strain limits.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import { browse, open, program, serve } from "./browser.mjs";

const run = promisify(execFile);
const PAPER = "impact-harvester-2019/harvester.toml";
let browser;
let noise;
let noisy;
let paper;
let page;
const until = (own, id, pattern) => own.waitForFunction(([name, source]) => new RegExp(source).test(document.getElementById(name).textContent), [id, pattern.source]);
const text = (own, id) => own.locator(`#${id}`).textContent();

before(async () => {
    browser = await browse();
    noise = await serve({ kind: "random-base" });
    noisy = await browser.context.newPage();
    await noisy.goto(noise.address);
});
after(async () => {
    await browser?.close();
    await noise?.close();
    await paper?.close();
});

test("the heading gives the mean power of the ensemble with its interval, and all warnings", async () => {
    await until(noisy, "operating-words", /realisations of the noise\)/);
    const [result, ensemble] = await Promise.all(["run", "ensemble"].map(async (command) => JSON.parse((await run(program, [command, noise.spec, "--json"])).stdout)));
    const words = await text(noisy, "operating-words");
    const [mean, half] = words.match(/^([\d.]+) µW ± ([\d.]+) µW \(95 %, 16 realisations/).slice(1).map(Number);
    assert.ok(Math.abs(mean / (1e6 * ensemble.mean_power_w) - 1) < 1e-3, words);
    assert.ok(Math.abs(half / (1e6 * ensemble.mean_power_half_width_w) - 1) < 0.05, words);
    const warnings = await text(noisy, "operating-warnings");
    const strain = /its strain reaches (-?\d+) ppm; its limit is 600 ppm/g;
    assert.deepEqual([...warnings.matchAll(strain)].length, 2, warnings);
    assert.ok(warnings.includes(`${(1e6 * result.warnings[0].reached).toFixed(0)} ppm`), warnings);
    assert.match(warnings, /16 of 16 members exceed the limit/);
});

test("the noise offered is that of the spec, with its unit, and is named as another one", async () => {
    const values = await Promise.all(["density", "low", "high"].map((name) => noisy.locator(`#shake-${name}`).inputValue()));
    assert.deepEqual(values, ["0.02", "5", "90"]);
    assert.equal(await text(noisy, "shake-density-unit"), "g²/Hz");
    assert.equal(await text(noisy, "shake-noise-title"), "Other noise in place of the first drive:");
    await noisy.locator("#shake-run").click();
    await until(noisy, "shake-words", /^other noise: [\d.]+ .?W on average over 45 s \(the same harvester without contact: [\d.]+ .?W\)/);
    assert.match(await text(noisy, "operating-words"), /the drives of the spec: [\d.]+ .?W on average over 18 s \(the same harvester without contact: [\d.]+ .?W\)/);
    const other = Number((await text(noisy, "shake-words")).match(/: ([\d.]+) µW/)[1]);
    assert.ok(other > 60 && other < 95, String(other));
});

test("tabs that cannot work are disabled with the reason, and Design maximises the mean power", async () => {
    for (const name of ["response", "load", "basins"]) {
        assert.ok(await noisy.locator(`#tab-${name}`).isDisabled());
        assert.match(await noisy.locator(`#tab-${name}`).getAttribute("title"), /no common period/);
    }
    assert.match(await text(noisy, "tabs-words"), /Response, Load and Basins need periodic motion/);
    assert.doesNotMatch(await noisy.locator("body").innerText(), /Sweep integrates/);
    await noisy.locator("#tab-shake").press("Home");
    assert.equal(await noisy.locator("#tab-design").getAttribute("aria-selected"), "true");
    await noisy.waitForFunction(() => document.getElementById("search-goal").value === "mean-power");
});

test("no panel of an orbit is shown", async () => {
    for (const width of [1280, 900, 390]) {
        await noisy.setViewportSize({ width, height: 800 });
        assert.ok(await noisy.locator("#orbit").isHidden(), `${width}`);
        // The page ends below its last panel, and no column is empty.
        const [panels, main] = await noisy.evaluate(() => [
            [...document.querySelectorAll("main > section")].map((own) => own.getBoundingClientRect()).filter(({ width }) => width > 0).map(({ right, bottom }) => [right, bottom]),
            document.querySelector("main").getBoundingClientRect().toJSON(),
        ]);
        assert.ok(Math.max(...panels.map(([right]) => right)) > main.right - 12 && Math.max(...panels.map(([, bottom]) => bottom)) > main.bottom - 12, `${width}: ${JSON.stringify([panels, main])}`);
    }
    await noisy.setViewportSize({ width: 1280, height: 800 });
});

test("a limit of a design has its origin", async () => {
    const limits = noisy.locator("#search-limits");
    await limits.locator("select").selectOption("patch.mfc.strain");
    await limits.getByRole("button", { name: "Add this limit" }).click();
    assert.match(await limits.locator(".row").innerText(), /600 ppm: recommended for the material of the patch/);
});

test("the heading has the strain, the voltage, the contacts and the warnings of every attractor", async () => {
    paper = await serve({ example: PAPER });
    page = await open(browser.context, paper.address);
    await until(page, "operating-words", /of 100 starts/);
    const words = await text(page, "operating-words");
    const result = JSON.parse((await run(program, ["run", paper.spec, "--json"])).stdout);
    const [strain, volts] = words.match(/strain ([\d.]+) ppm, voltage ([\d.]+) V peak, 1 contact per drive cycle/).slice(1).map(Number);
    assert.ok(Math.abs(strain / (1e6 * result.patches[0].strain_peak) - 1) < 5e-3, words);
    assert.ok(Math.abs(volts / result.patches[0].voltage_peak_v - 1) < 5e-3, words);
    const frequency = page.getByLabel("drive.shaker.frequency, value", { exact: true });
    await frequency.fill("12.56");
    await frequency.press("Enter");
    await until(page, "operating-words", /At 12\.56 Hz.* of 100 starts/);
    assert.match(await text(page, "operating-warnings"), /^beam: its deflection reaches 59 % of its length/);
    const gap = page.getByLabel("stop.tip.gap, value", { exact: true });
    await gap.fill("200");
    await gap.press("Enter");
    await until(page, "operating-words", /, the stop is not struck/);
});

test("a strain limit that the spec lacks is set on the page", async () => {
    await page.locator("#groups > details:has(input[aria-label='patch.mfc.strain_limit, value']) > summary").click();
    const field = page.getByLabel("patch.mfc.strain_limit, value", { exact: true });
    assert.equal(await field.getAttribute("placeholder"), "none");
    await field.fill("100");
    await field.press("Enter");
    await until(page, "operating-words", /strain [\d.]+ ppm of 100/);
    await until(page, "operating-safety", /beyond its limit of 100 ppm/);
    assert.equal(await page.locator("#faults").textContent(), "");
});
