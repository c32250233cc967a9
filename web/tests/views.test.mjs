// The views of the page: what each exports, and what it says of points, orbits and ranges.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { ready } from "./browser.mjs";
import { page, server, type, until } from "./suite.mjs";

const text = (id) => page.locator(`#${id}`).textContent();
const shot = async (name) => process.env.SHOTS && page.screenshot({ path: `${process.env.SHOTS}/${name}.png` });
const exported = async (id) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.locator(`#export-${id}`).click()]);
    const path = `${server.folder}/${download.suggestedFilename()}`;
    await download.saveAs(path);
    return { name: download.suggestedFilename(), content: await readFile(path) };
};
const dialog = async () => {
    await page.locator("#export").click();
    await page.locator("#export-dialog").waitFor({ state: "visible" });
};
const basins = async () => {
    await page.locator("#tab-basins").click();
    await page.locator("#basins-starts").selectOption("225");
    await page.locator("#basins-run").click();
    await until("basins-words", /expected power/);
};

test("the export has picture and table of the tab that is shown", async () => {
    await basins();
    await dialog();
    await shot("export");
    const [table, picture, vectors] = [await exported("table"), await exported("picture"), await exported("vectors")];
    assert.deepEqual([table, picture, vectors].map(({ name }) => name), ["harvester-basins.csv", "harvester-basins.png", "harvester-basins.svg"]);
    const lines = table.content.toString().trim().split("\n");
    assert.equal(lines[0], "displacement_m,velocity_m_s,attractor,period_cycles,mean_power_w");
    assert.equal(lines.length, 226);
    const first = (await page.locator("#attractors button").first().textContent()).match(/^(\w+): ([\d.]+) %/);
    assert.ok(Math.abs(lines.filter((line) => line.split(",")[2] === first[1]).length / 225 - Number(first[2]) / 100) < 1e-3);
    const chart = await page.locator("#chart-basins canvas").evaluate(({ width, height }) => [width, height]);
    assert.deepEqual([picture.content.readUInt32BE(16), picture.content.readUInt32BE(20)], chart);
    assert.match(vectors.content.toString(), /Displacement/);
    await page.keyboard.press("Escape");
    await page.locator("#tab-modes").click();
    await dialog();
    assert.match(await text("export-shown"), /Modes has no chart/);
    for (const id of ["table", "picture", "vectors"]) assert.ok(await page.locator(`#export-${id}`).isDisabled(), id);
    await page.keyboard.press("Escape");
    await page.locator("#tab-response").click();
});

test("the sentence below the basins and the button follow the orbit that is shown", async () => {
    await type("drive.shaker.frequency", "12.55");
    await ready(page);
    await until("operating-words", /of 100 starts/);
    await basins();
    await ready(page);
    const buttons = page.locator("#attractors button");
    const entries = (await buttons.allTextContents()).map((words) => words.match(/^(\w+): .*, ([\d.]+) (.?W)$/).slice(1));
    assert.ok(entries.length > 1, entries.join("; "));
    for (let k = 0; k < 2; k++) {
        await buttons.nth(k).click();
        await until("basins-note", new RegExp(`The orbit of ${entries[k][0]} is shown`));
        const [, power, unit] = (await text("orbit-title")).match(/: ([\d.]+) (.?W), /);
        assert.ok(unit === entries[k][2] && Math.abs(power / entries[k][1] - 1) < 0.01, `${await text("orbit-title")} ${entries[k]}`);
        const [, own] = (await text("operating-words")).match(/: ([\d.]+) .?W/);
        assert.equal(await page.locator("#operating-show").isVisible(), Math.abs(own / power - 1) > 0.01, `${own} ${power}`);
    }
    await shot("basins-picked");
    if (await page.locator("#operating-show").isHidden()) await buttons.first().click();
    await page.locator("#operating-show").waitFor({ state: "visible" });
    await page.locator("#operating-show").click();
    await ready(page);
    const [, power] = (await text("orbit-title")).match(/: ([\d.]+) .?W, /);
    const name = (await text("basins-note")).match(/The orbit of (\w+) is shown/)[1];
    assert.ok(Math.abs(power / entries.find(([own]) => own === name)[1] - 1) < 0.01);
    assert.ok(await page.locator("#operating-show").isHidden());
});

test("after a change of the design the panel shows its operating point", async () => {
    await page.locator("#tab-response").click();
    await page.locator("#over").selectOption("stop.tip.gap");
    await ready(page);
    await page.locator("#chart-response").focus();
    for (let k = 0; k < 3; k++) await page.keyboard.press("PageDown");
    await page.locator("#operating-show").waitFor({ state: "visible" });
    await ready(page);
    assert.doesNotMatch(await text("orbit-title"), /^Orbit at 1 mm/);
    await type("drive.shaker.frequency", "12.56");
    await until("operating-words", /^At 12\.56 Hz: .*of 100 starts/);
    await ready(page);
    assert.match(await text("orbit-title"), /^Orbit at 1 mm: .*, stable/);
    assert.ok(await page.locator("#operating-show").isHidden());
});

test("a value outside the shown range is named, and the range extends to it", async () => {
    await page.locator("#reset").click();
    await page.locator("#over").selectOption("drive.shaker.frequency");
    await ready(page);
    await type("drive.shaker.frequency", "9");
    await until("orbit-title", /^9 Hz is outside the shown range$/);
    await shot("outside");
    await page.locator("#orbit-extend").click();
    await ready(page);
    assert.ok(Number(await page.locator("#from").inputValue()) < 9);
    assert.match(await text("orbit-title"), /^Orbit at 9 Hz: .*, stable/);
    assert.ok(await page.locator("#orbit-extend").isHidden());
    await page.locator("#reset").click();
    await ready(page);
});

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
