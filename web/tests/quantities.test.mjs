// Quantities of the response against `jounce run` at the same value of the key; the logarithmic axis and values of 0.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { readFile, writeFile } from "node:fs/promises";
import { test } from "node:test";
import { promisify } from "node:util";
import { inked, open, program, ready, serve } from "./browser.mjs";
import { browser, page, server, type, until } from "./suite.mjs";

const run = promisify(execFile);
const PREFIXES = { n: 1e-9, µ: 1e-6, m: 1e-3, "": 1, k: 1e3 };

/** Values of the selected point in the words of the page. */
const selected = async (own) => {
    const words = await own.locator("#chart-response").getAttribute("aria-valuetext");
    const [hertz, , quantity] = words.split(", ");
    return { words, hertz: Number(hertz.split(" ")[0]), quantity };
};
/** A value with its unit, SI. */
const si = (words, unit) => {
    const [, number, prefix] = words.match(new RegExp(`(-?[\\d.]+) (n|µ|m|k|)${unit}$`)) ?? assert.fail(words);
    return Number(number) * PREFIXES[prefix];
};
/** Quantities that the page offers. */
const offered = (own) => own.locator("#quantity option:not([hidden])").evaluateAll((options) => options.map(({ value }) => value));
const running = async (spec, hertz, key) => JSON.parse((await run(program, ["run", spec, "--set", `${key}=${hertz} Hz`, "--json"])).stdout);

test("contact force, impact speed and strain are those of `jounce run`", async () => {
    const show = page.locator("#quantity");
    // A point of the upper branch, on which a run from rest settles as well.
    await page.locator("#chart-response").focus();
    for (let k = 0; k < 4; k++) await page.keyboard.press("ArrowRight");
    await ready(page);
    const { hertz } = await selected(page);
    const due = await running(server.spec, hertz, "drive.shaker.frequency");
    for (const [quantity, unit, words, value] of [
        ["force", "N", "contact force, peak", due.max_contact_force_n],
        ["impact", "m/s", "impact speed, largest", due.stops[0].max_impact_velocity_m_s],
        ["strain", "ppm", "strain, peak", 1e6 * due.patches[0].strain_peak],
    ]) {
        await show.selectOption(quantity);
        await page.waitForFunction((start) => document.getElementById("chart-response").ariaValueText.includes(`, ${start} `) && !/–/.test(document.getElementById("chart-response").ariaValueText), words);
        const own = await selected(page);
        assert.equal(own.hertz, hertz);
        assert.ok(si(own.words.match(new RegExp(`${words} ([^,]+)`))[1], unit) / value > 0.998 && si(own.words.match(new RegExp(`${words} ([^,]+)`))[1], unit) / value < 1.002, `${own.words} ${value}`);
        assert.ok((await inked(page, "#chart-response canvas")) > 0.005, quantity);
    }
    // The strain of the next design is requested anew.
    await type("stop.tip.gap", "1.2");
    await ready(page);
    await page.waitForFunction(() => /strain, peak [\d.]+ ppm/.test(document.getElementById("chart-response").ariaValueText));
    await page.locator("#reset").click();
    await show.selectOption("power");
    await ready(page);
});

test("the strain limit is on the chart of the strain", async () => {
    const spec = await readFile(server.spec, "utf8");
    await page.locator("#quantity").selectOption("strain");
    await writeFile(server.spec, spec.replace("[patch.mfc] ", "[patch.mfc]\nstrain_limit = 300e-6\n#"));
    await until("readout", /The strain limit is 300 ppm; all stable orbits found stay below it from [\d.]+ Hz to 14\.82 Hz\./);
    // Runs inside the ranges keep the limit; at an end that is none of a branch, the strain is just below the limit.
    await writeFile(server.spec, spec.replace("[patch.mfc] ", "[patch.mfc]\nstrain_limit = 2000e-6\n#"));
    await until("readout", /The strain limit is 2000 ppm; all stable orbits found stay below it from/);
    const sentence = (await page.locator("#readout").textContent()).match(/stay below it .*/)[0];
    const ranges = [...sentence.matchAll(/from ([\d.]+) Hz to ([\d.]+) Hz/g)].map(([, from, to]) => [Number(from), Number(to)]);
    assert.ok(ranges.length === 3 && ranges[0][0] === 11.44 && ranges[2][1] === 14.82, sentence);
    const strain = async (hertz) => (await running(server.spec, hertz, "drive.shaker.frequency")).patches[0].strain_peak;
    for (const [from, to] of ranges) assert.ok((await strain((from + to) / 2)) < 2e-3, `${from} to ${to}`);
    const last = await strain(ranges[0][1]);
    assert.ok(last < 2e-3 && last > 1.9e-3, `${sentence} ${last}`);
    await writeFile(server.spec, spec);
    await page.waitForFunction(() => !/strain limit/.test(document.getElementById("readout").textContent));
    await page.locator("#quantity").selectOption("power");
    await ready(page);
});

test("with a rectified circuit the voltage is that of its storage", async () => {
    const rectified = await serve({ kind: "bimorph-with-rectifier" });
    const own = await open(browser.context, rectified.address);
    assert.equal(await own.locator("#quantity option[value=voltage]").textContent(), "storage voltage, rms");
    await own.locator("#quantity").selectOption("voltage");
    const { words, hertz } = await selected(own);
    const key = (await readFile(rectified.spec, "utf8")).match(/\[(drive\.[^\]]+)\]/)[1];
    const due = (await running(rectified.spec, hertz, `${key}.frequency`)).rectified[0].voltage_rms_v;
    const shown = si(words.match(/storage voltage, rms ([^,]+)/)[1], "V");
    assert.ok(Math.abs(shown / due - 1) < 2e-3, `${words} ${due}`);
    // Without a stop there is no contact to show.
    assert.deepEqual(await offered(own), ["power", "voltage", "strain", "floquet"]);
    assert.ok(await own.locator("#grazings").isHidden());
    await own.close();
    await rectified.close();
});

test("quantities of contact are offered where there is a stop, and give way when it goes", async () => {
    const CONTACT = ["penetration", "force", "impact", "displacement"];
    const missing = async () => CONTACT.filter((own) => !shown.includes(own));
    let shown = await offered(page);
    assert.deepEqual(await missing(), []);
    await page.locator("#quantity").selectOption("force");
    const spec = await readFile(server.spec, "utf8");
    await writeFile(server.spec, spec.replace(/\[stop\.tip\][^[]*/, ""));
    await page.waitForFunction(() => document.getElementById("quantity").value === "power");
    await ready(page);
    shown = await offered(page);
    assert.deepEqual(await missing(), CONTACT);
    assert.match(await page.locator("#chart-response").getAttribute("aria-label"), /^Mean power over/);
    await writeFile(server.spec, spec);
    await page.locator("#quantity option[value=force]:not([hidden])").waitFor({ state: "attached" });
    await ready(page);
});

test("a logarithmic axis says which points it cannot show, and is linear where all values are 0", async () => {
    // Far from resonance the tip does not reach the stop.
    await type("stop.tip.gap", "20");
    await ready(page);
    await page.locator("#quantity").selectOption("penetration");
    await until("readout", /On the logarithmic axis \d+ of \d+ points are missing, because their value is 0\./);
    await page.locator("#log").uncheck();
    assert.doesNotMatch(await page.locator("#readout").textContent(), /logarithmic/);
    await page.locator("#log").check();
    await page.locator("#quantity").selectOption("power");
    await page.locator("#reset").click();
    await ready(page);
    const oscillator = await serve({ example: "bouncing-and-impact-oscillators/impact.toml" });
    const own = await open(browser.context, oscillator.address);
    await until("readout", /All values are 0, so the axis is linear\./, own);
    // The curve at 0 is drawn.
    const blue = await own.locator("#chart-response canvas").evaluate((canvas) => {
        const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        let count = 0;
        for (let k = 0; k < data.length; k += 4) count += data[k] < 20 && Math.abs(data[k + 1] - 114) < 20 && Math.abs(data[k + 2] - 178) < 20 && data[k + 3] > 200 ? 1 : 0;
        return count;
    });
    assert.ok(blue > 100, String(blue));
    await own.close();
    await oscillator.close();
});

test("diodes that do not conduct pass no power, and the harvester has one orbit", async () => {
    const rectified = await serve({ kind: "bimorph-with-rectifier" });
    const own = await open(browser.context, rectified.address);
    // A longer shim moves the resonance out of the range. The search also starts from the orbits of the spec, whose diodes conduct.
    const { stdout } = await run(program, ["run", rectified.spec, "--set", "beam.shim.length=74.9 mm", "--json"]);
    assert.ok(JSON.parse(stdout).mean_power_w < 1e-21, stdout);
    const length = own.getByLabel("beam.shim.length, value", { exact: true });
    await length.evaluate((field) => field.closest("details")?.setAttribute("open", ""));
    await length.fill("74.9");
    await length.press("Enter");
    await until("operating-words", /^At 47 Hz: 0 W, period 1, stable/, own);
    await ready(own);
    const words = await own.locator("#readout").textContent();
    assert.match(words, /^Stable orbits found: 1 in the complete range\. .*All values are 0, so the axis is linear\./);
    assert.equal(await own.locator("#bifurcations tr").count(), 0);
    await own.close();
    await rectified.close();
});

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
