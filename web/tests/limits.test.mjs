// What the page says of limits and stability: for all starts, and at a bifurcation.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { test } from "node:test";
import { promisify } from "node:util";
import { program, ready } from "./browser.mjs";
import { page, server, type, until } from "./suite.mjs";

const run = promisify(execFile);
const text = (id) => page.locator(`#${id}`).textContent();
const asked = async (command, ...set) => JSON.parse((await run(program, [command, server.spec, ...set.flatMap((own) => ["--set", own]), "--json"])).stdout);
const limit = async (ppm) => {
    const field = page.getByLabel("patch.mfc.strain_limit, value", { exact: true });
    await field.fill(ppm);
    await field.press("Enter");
};

test("with one attractor the sentence has the strain, the voltage and the impact speed of a run, and what is not known", async () => {
    await page.locator("#groups > details").evaluateAll((list) => list.forEach((group) => (group.open = true)));
    await page.locator("#groups details").evaluateAll((list) => list.forEach((group) => (group.open = true)));
    await until("operating-safety", /all 100 starts/);
    assert.match(await text("operating-safety"), /the strain is at most [\d.]+ ppm \(no limit given; set the strain limit of a patch\)/);
    await limit("600 ppm");
    await until("operating-safety", /^Settled motion after all 100 starts: the strain stays below 600 ppm/);
    const words = await text("operating-safety");
    const [strain, speed, unit, other] = words.match(/stays below 600 ppm \(at most ([\d.]+) ppm\).*, and the stop is struck at most at ([\d.]+) (.?m)\/s\. At most ([\d.]+) % of such starts \(95 %\) lead elsewhere\.$/).slice(1);
    const result = await asked("run", "patch.mfc.strain_limit=600 ppm");
    assert.ok(Math.abs(strain / (1e6 * result.patches[0].strain_peak) - 1) < 5e-3, words);
    const velocity = result.stops[0].max_impact_velocity_m_s ?? result.stops[0].max_impact_speed_m_s;
    assert.ok(Math.abs((speed * (unit === "mm" ? 1e-3 : 1)) / velocity - 1) < 1e-2, `${words} ${velocity}`);
    // No starts of 100 elsewhere: the upper end of Wilson's interval of 0 of 100.
    assert.ok(Math.abs(Number(other) - (100 * 1.96 ** 2) / (100 + 1.96 ** 2)) < 0.06, words);
});

test("an attractor beyond a limit is named with the excess and its share of the starts", async () => {
    const { patches: [{ strain_peak: calm }] } = await asked("run");
    await limit(`${((1e6 * calm) / 1.25).toFixed(3)} ppm`);
    await until("operating-safety", /^Not within the limits after every start: at [\d.]+ .?W \(100 % of the starts, 95 %: 96 to 100\) the strain of patch mfc is [\d.]+ ppm, 25 % beyond its limit of [\d.]+ ppm\.$/);
    await limit("2000 ppm");
    await type("drive.shaker.frequency", "12.55");
    await until("operating-words", /At 12\.55 Hz.*of 100 starts/);
    const { attractors } = await asked("basins", "drive.shaker.frequency=12.55 Hz", "patch.mfc.strain_limit=2000 ppm");
    const over = attractors.filter((own) => own.warnings.length > 0);
    assert.ok(over.length > 0 && over.length < attractors.length, JSON.stringify(attractors.map((own) => own.warnings)));
    const words = await text("operating-safety");
    const parts = [...words.matchAll(/at ([\d.]+) (.?)W \(([\d.]+) % of the starts, 95 %: ([\d.]+) to ([\d.]+)\) the strain of patch mfc is ([\d.]+) ppm/g)];
    assert.equal(parts.length, over.length, words);
    parts.forEach(([, power, , , low, high, strain], k) => {
        const own = over[k];
        assert.ok(Number(high) >= 100 * own.fraction_low && Number(low) <= 100 * own.fraction_high, words);
        assert.ok(Math.abs(String(own.mean_power_w * 10 ** Math.round(Math.log10(power / own.mean_power_w))) / power - 1) < 1e-3, words);
        assert.ok(Math.abs(strain / (1e6 * Math.abs(own.warnings[0].reached)) - 1) < 1e-2, `${words} ${own.warnings[0].reached}`);
    });
    assert.match(words, /; after \d+ of 100 starts the limits are kept\.$/);
});

test("an orbit at a fold is at the stability limit, neither stable nor unstable", async () => {
    await page.locator("#reset").click();
    await ready(page);
    await page.locator("#bifurcations-title").click();
    const rows = await page.locator("#bifurcations button").allTextContents();
    assert.ok(rows.includes("fold"), rows.join());
    for (const [k, kind] of rows.entries()) {
        await page.locator("#bifurcations button").nth(k).click();
        await ready(page);
        if (kind === "fold") assert.match(await text("orbit-title"), /, at the stability limit \(fold\)$/);
        else if (["grazing", "sticking"].includes(kind)) assert.match(await text("orbit-title"), /, (un)?stable$/);
    }
    const fold = rows.indexOf("fold");
    await page.locator("#bifurcations button").nth(fold).click();
    await ready(page);
    assert.match(await page.locator("#chart-response").getAttribute("aria-valuetext"), /^fold, /);
    assert.match(await page.locator("#chart-multipliers").getAttribute("aria-label"), /at the stability limit \(fold\)/);
});

test("basins: the plane is that of the fields, named with the number of starts; a result of another plane is marked", async () => {
    await page.locator("#tab-basins").click();
    await page.locator("#basins-starts").selectOption("225");
    await page.locator("#basins-displacement-from").fill("-2");
    await page.locator("#basins-run").click();
    await until("basins-words", /give both ends of the displacement/);
    await page.locator("#basins-displacement-to").fill("1500 um");
    await page.locator("#basins-run").click();
    await until("basins-words", /15 x 15 starts, displacement -2 mm to 1\.5 mm, velocity -[\d.]+ .?m\/s to [\d.]+ .?m\/s$/);
    assert.ok(await page.locator("#basins-stale").isHidden());
    // The grid of the command line gives the same attractors and shares.
    const velocity = (await text("basins-words")).match(/velocity (\S+ \S+) to (\S+ \S+)$/).slice(1).map((own) => own.replace(" ", ""));
    const { stdout } = await run(program, ["basins", server.spec, "--grid", "displacement=-2mm:1.5mm:15x", "--grid", `velocity=${velocity.join(":")}:15x`, "--json"]);
    const shares = (await page.locator("#attractors button").allTextContents()).map((own) => own.match(/^(\w+): ([\d.]+) %/).slice(1));
    const due = JSON.parse(stdout).attractors.map((own) => [own.id, 100 * own.fraction]);
    assert.deepEqual(shares.map(([id]) => id), due.map(([id]) => id));
    shares.forEach(([, share], k) => assert.ok(Math.abs(share - due[k][1]) < 1, `${shares} ${due}`));
    await page.locator("#basins-displacement-from").fill("-3");
    await page.locator("#basins-displacement-from").press("Enter");
    await page.waitForFunction(() => document.getElementById("basins-stale").textContent === "of other starts" && !document.getElementById("basins-stale").hidden);
    await page.locator("#basins-displacement-from").fill("-2");
    await page.locator("#basins-displacement-from").press("Tab");
    await page.locator("#basins-stale").waitFor({ state: "hidden" });
    await page.locator("#basins-displacement-to").fill("-4");
    await page.locator("#basins-run").click();
    await until("basins-words", /the range must go from a smaller to a larger value/);
});

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
