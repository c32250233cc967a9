// The views of the page: what each exports, and what it says of points, orbits and ranges.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { inked, ready } from "./browser.mjs";
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
    assert.equal(picture.content.readUInt32BE(16), 2 * chart[0]);
    assert.ok(picture.content.readUInt32BE(20) > 2 * chart[1], "the legend is below the chart");
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
        // The ring is at the point of the curves that has this orbit.
        await ready(page);
        const [, ring, ringUnit] = (await page.locator("#chart-response").getAttribute("aria-valuetext")).match(/Hz, ([\d.]+) (.?W), period 1, stable/) ?? assert.fail(entries[k][0]);
        assert.ok(ringUnit === unit && Math.abs(ring / power - 1) < 0.1, `${ring} ${power}`);
        const [, own] = (await text("operating-words")).match(/: ([\d.]+) .?W/);
        assert.equal(await page.locator("#operating-show").isVisible(), Math.abs(own / power - 1) > 0.01, `${own} ${power}`);
    }
    await shot("basins-picked");
    // At 1280 x 800 map and legend are complete without scrolling.
    const [height, shown] = await page.locator("#panel-basins").evaluate((panel) => [panel.scrollHeight, panel.clientHeight]);
    assert.ok(height <= shown, `${height} of ${shown}`);
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
    await until("orbit-extend", /^9 Hz is outside the shown range: extend it$/);
    await until("orbit-title", /^Orbit at 9 Hz: .*, stable/);
    await shot("outside");
    await page.locator("#orbit-extend").click();
    await ready(page);
    assert.ok(Number(await page.locator("#from").inputValue()) < 9);
    assert.match(await text("orbit-title"), /^Orbit at 9 Hz: .*, stable/);
    assert.ok(await page.locator("#orbit-extend").isHidden());
    await page.locator("#reset").click();
    await ready(page);
});

test("a motion without a period keeps its words when the basins arrive", async () => {
    await type("drive.shaker.frequency", "12.7");
    await until("orbit-title", /^Most starts end in torus, which has no periodic orbit/);
    await ready(page);
    // Its motion: a point per drive cycle in the phase portrait, and its histories.
    await until("stretch-words", /^500 drive cycles from a start that reached it: Poincaré section, a point at the start of each cycle; histories of the first 20\./);
    assert.match(await page.locator("#chart-phase").getAttribute("aria-label"), /^Poincaré section: .* of 500 drive cycles$/);
    for (const id of ["phase", "displacement", "voltage"]) assert.ok(await inked(page, `#chart-${id} canvas`) > 0.01, id);
    for (const id of ["force", "spectrum", "multipliers"]) assert.ok(await page.locator(`#chart-${id}`).isHidden(), id);
    assert.ok(await page.locator("#motion").isHidden());
    await shot("torus");
    await basins();
    await ready(page);
    assert.match(await text("orbit-title"), /^Most starts end in torus, which has no periodic orbit/);
    await page.locator("#tab-response").click();
    await page.locator("#reset").click();
    await ready(page);
    await until("orbit-title", /^Orbit at 13 Hz/);
    assert.ok(await page.locator("#chart-multipliers").isVisible());
    assert.equal(await text("stretch-words"), "");
});

test("a row of a bifurcation shows its own orbit, and the draft is described apart from the result", async () => {
    await page.locator("#bifurcations-title").click();
    const rows = await page.locator("#bifurcations tr").count();
    assert.ok(rows > 2);
    for (let k = 0; k < rows; k++) {
        await page.locator("#bifurcations button").nth(k).click();
        await ready(page);
        const [, x, error, power, unit] = (await page.locator("#bifurcations tr").nth(k).innerText()).match(/([\d.]+) ± ([\d.e-]+) Hz\s+([\d.]+) (.?W)/);
        const [, at, own, ownUnit] = (await text("orbit-title")).match(/^Orbit at ([\d.]+) Hz: ([\d.]+) (.?W)/);
        assert.ok(Math.abs(at / x - 1) < 1e-4 && error < 1e-6 && x.replace(".", "").length === 9, `${at}, ${x} ± ${error}`);
        assert.ok(Math.abs(own / power - 1) < 1e-3 && unit === ownUnit, `${own} ${ownUnit}, ${power} ${unit}`);
    }
    await page.locator("#bifurcations-title").click();
    await type("stop.tip.gap", "1.05");
    await ready(page);
    assert.doesNotMatch(await text("readout"), /draft/i);
    assert.match(await text("draft-words"), /^The last draft was off by at most /);
    await page.locator("#reset").click();
    await ready(page);
});

test("a strain that is not computed yet has words and no numbers on its axis", async () => {
    // Text of the chart, as it is drawn.
    await page.evaluate(() => {
        window.drawn = [];
        const own = CanvasRenderingContext2D.prototype.fillText;
        CanvasRenderingContext2D.prototype.fillText = function (words, ...place) {
            if (this.canvas.closest("#chart-response")) window.drawn.push(words);
            return own.call(this, words, ...place);
        };
    });
    await page.locator("#quantity").selectOption("strain");
    await page.waitForFunction(() => window.drawn.includes("computing strain"));
    await shot("strain-computing");
    // The chart of the power may have been drawn before.
    const labels = await page.evaluate(() => {
        const { drawn } = window;
        const words = drawn.indexOf("computing strain");
        return drawn.slice(drawn.lastIndexOf("Strain, peak (ppm)", words), words);
    });
    assert.ok(labels.length > 0 && !labels.some((own) => /^[\d.]+$/.test(own)), labels.join());
    await page.waitForFunction(() => !/Computing the strain/.test(document.getElementById("readout").textContent));
    await page.evaluate(() => (window.drawn = []));
    await page.locator("#log").uncheck();
    await page.waitForFunction(() => window.drawn.length > 3);
    assert.ok(!(await page.evaluate(() => window.drawn)).includes("computing strain"));
    await shot("strain");
    await page.locator("#log").check();
    await page.locator("#quantity").selectOption("power");
});

test("both shares say which starts they count, and the basins say what is shown", async () => {
    await ready(page);
    await until("operating-words", /reached by [\d.]+ % \(95 %: [\d.]+ to [\d.]+\) of 100 starts drawn at random/);
    await basins();
    assert.match(await page.locator("#attractors button").first().textContent(), /of the starts of the map/);
    assert.ok(await page.locator("#basins-about").isHidden());
    const box = await page.locator("#chart-basins .u-over").boundingBox();
    const before = await page.locator("#chart-basins canvas").evaluate((own) => own.toDataURL());
    await page.mouse.click(box.x + 0.7 * box.width, box.y + 0.3 * box.height);
    await until("basins-cursor", /^Start at [\d.]+ mm, [\d.]+ .?m\/s: \w+, [\d.]+ .?W$/);
    await until("basins-note", /The orbit of \w+ is shown|No branch/);
    assert.notEqual(await page.locator("#chart-basins canvas").evaluate((own) => own.toDataURL()), before);
    await shot("basins");
    await page.locator("#theme").click();
    await shot("basins-dark");
    await page.locator("#theme").click();
    await page.locator("#tab-response").click();
});

test("the points of a sweep have their own symbols, and the curve without contact its name", async () => {
    await page.locator("#sweep").click();
    await until("sweep", /^Stop/);
    await until("sweep", /^Sweep$/);
    await shot("sweep");
    const symbols = await page.locator("#panel-response details").last().textContent();
    assert.match(symbols, /△ sweep up, ▽ sweep down/);
    await page.evaluate(() => (window.drawn = []));
    await page.locator("#log").uncheck();
    await page.waitForFunction(() => window.drawn.includes("without contact"));
    await page.locator("#log").check();
});

test("a wrong range and a gap of stable orbits have words, and a save names the file", async () => {
    await page.locator("#from").fill("80");
    await page.locator("#from").press("Enter");
    await until("range-fault", /The range must go from a smaller to a larger number/);
    await shot("range-fault");
    await page.locator("#from").fill("11.44");
    await page.locator("#from").press("Enter");
    await page.locator("#range-fault").waitFor({ state: "hidden" });
    // The range is that of the present response, so none is requested and the status remains that of the sweep.
    await until("readout", /, no stable periodic orbit up to 12\.802 Hz, then 1\./);
    await type("stop.tip.gap", "0.9");
    await ready(page);
    await page.locator("#save").click();
    await page.locator("#save-write").click();
    await until("reply", /^saved as harvester.toml$/);
    await ready(page);
    // No later notice of the file and no result replaces the reply.
    assert.equal(await page.locator("#reply").textContent(), "saved as harvester.toml");
});

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
