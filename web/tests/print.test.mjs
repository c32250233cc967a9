// Paper: prints of the page, its charts as vectors, and the PDF files of the commands, as poppler reads them.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { test } from "node:test";
import { program } from "./browser.mjs";
import { compare, heights, missing, read, render } from "./paper.mjs";
import { field, page, server, until } from "./suite.mjs";

const png = (content) => `data:image/png;base64,${content.toString("base64")}`;
const svg = (content) => `data:image/svg+xml;base64,${content.toString("base64")}`;

/** A file that a button of the export saves. */
async function exported(button) {
    await page.locator("#export").click();
    await page.locator("#export-dialog").waitFor({ state: "visible" });
    const [download] = await Promise.all([page.waitForEvent("download"), page.locator(button).click()]);
    const path = join(server.folder, download.suggestedFilename());
    await download.saveAs(path);
    await page.keyboard.press("Escape");
    return readFile(path);
}

test("a print is light, with vectors, letters as text and without controls", { skip: missing }, async () => {
    await page.locator("#theme").click();
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
    const path = join(server.folder, "print.pdf");
    await page.pdf({ path, preferCSSPageSize: true });
    const { images, outside, inside, text } = read(path);
    assert.deepEqual([images, outside], [0, []]);
    assert.ok(inside > 0);
    for (const words of ["harvester.toml", "Drive frequency (Hz)", "Mean power (mW)", "12.5", "Position (mm)", "Multiplier, real", "gap 1 mm"]) assert.ok(text.includes(words), `${words}\n${text}`);
    for (const words of ["Undo", "Export", "slower", "grazings", "Young"]) assert.ok(!text.includes(words), `${words}\n${text}`);
    render(path, join(server.folder, "print"), 200);
    const picture = png(await readFile(join(server.folder, "print.png")));
    const { inked } = await compare(page, picture, picture);
    assert.ok(inked > 0.005 && inked < 0.1, `${inked}`);
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
    assert.equal(await page.locator(".printed").count(), 0);
    await page.locator("#theme").click();
    assert.deepEqual(page.faults, []);
});

test("a print says what is changed in the design", { skip: missing }, async () => {
    await field("stop.tip.gap").fill("0.8");
    await field("stop.tip.gap").press("Enter");
    await page.waitForFunction(() => /gap 0\.8 mm/.test(document.getElementById("close").textContent));
    const path = join(server.folder, "changed.pdf");
    await page.pdf({ path, preferCSSPageSize: true });
    assert.match(read(path).text, /stop\.tip\.gap = 0\.8 ?mm/);
    await page.locator("#reset").click();
});

test("letters of printed charts have one size on a sheet, whatever the width of the window", { skip: missing }, async () => {
    for (const [paper, format] of [["A4", { width: "210mm", height: "297mm" }], ["A5", { width: "148mm", height: "210mm" }]]) {
        for (const width of [390, 1280, 2560]) {
            await page.setViewportSize({ width, height: 844 });
            await page.waitForTimeout(300);
            const path = join(server.folder, "size.pdf");
            await page.pdf({ path, ...format });
            const sizes = ["Drive", "Time"].flatMap((word) => heights(path, word));
            assert.ok(sizes.length >= 2 && sizes.every((size) => size > 6 && size < 14), `${paper}, ${width} px: ${sizes} points`);
        }
    }
    await page.setViewportSize({ width: 1280, height: 800 });
});

test("printed basins have their legend", { skip: missing }, async () => {
    await page.locator("#tab-basins").click();
    await page.locator("#basins-starts").selectOption("225");
    await page.locator("#basins-run").click();
    await until("basins-words", /expected power/);
    const path = join(server.folder, "basins.pdf");
    await page.pdf({ path });
    assert.match(read(path).text, /1a: [\d.]+ % of the starts of the map/);
    await page.locator("#tab-response").click();
});

test("the saved vectors of the response are the picture of its canvas", async () => {
    await page.waitForFunction(() => !document.querySelector("[aria-busy=true]") && /branch/.test(document.getElementById("chart-response").ariaLabel));
    await page.evaluate(() => (document.getElementById("export-size").value = "1"));
    const [vectors, pixels] = [await exported("#export-vectors"), await exported("#export-picture")];
    const { different, inked, sizes } = await compare(page, png(pixels), svg(vectors));
    assert.deepEqual(sizes[0], sizes[1]);
    assert.ok(inked > 0.01 && different < 0.1 * inked, `${different} of ${inked}`);
    assert.ok(vectors.includes(">unstable</text>"), "the legend");
    assert.ok(vectors.includes(">Drive frequency (Hz)</text>") && !vectors.includes("<image"));
});

test("the PDF of a command is its picture, with letters inside", { skip: missing }, async () => {
    for (const [line, stem, words] of [
        ["show harvester.toml --out tip", "tip", "stop tip, gap 1 mm"],
        ["modes harvester.toml --out modes", "modes/modes-beam", "Position along the beam (mm)"],
    ]) {
        for (const ending of line.startsWith("show") ? [".pdf", ".png"] : [""]) {
            const { status, stderr } = spawnSync(program, (line + ending).split(" "), { cwd: server.folder, encoding: "utf8" });
            assert.equal(status, 0, stderr);
        }
        const path = join(server.folder, stem);
        const { images, outside, inside, text } = read(`${path}.pdf`);
        assert.deepEqual([images, outside, inside], [0, [], 1]);
        assert.ok(text.includes(words), text);
        render(`${path}.pdf`, `${path}-paper`, 192);
        const { different, inked, sizes } = await compare(page, png(await readFile(`${path}.png`)), png(await readFile(`${path}-paper.png`)));
        sizes[0].forEach((length, k) => assert.ok(Math.abs(length - sizes[1][k]) <= 1, JSON.stringify(sizes)));
        assert.ok(inked > 0.01 && different < 0.1 * inked, `${line}: ${different} of ${inked}`);
    }
});
