// The page without a mouse: names and roles in the tree of a screen reader, the order and the sight of the focus, keys for all that the
// mouse can do.
import assert from "node:assert/strict";
import { test } from "node:test";
import { ready } from "./browser.mjs";
import { enter, field, page, type, until } from "./suite.mjs";

const active = () => page.evaluate(() => document.activeElement.id || document.activeElement.ariaLabel || document.activeElement.textContent.trim() || document.activeElement.tagName);
/** Nodes of the tree of a screen reader. */
const tree = async () => {
    const session = await page.context().newCDPSession(page);
    const { nodes } = await session.send("Accessibility.getFullAXTree");
    await session.detach();
    return nodes.filter((node) => !node.ignored).map((node) => ({
        role: node.role?.value, name: node.name?.value ?? "", text: node.value?.value,
        ...Object.fromEntries((node.properties ?? []).map(({ name, value }) => [name, value.value])),
    }));
};
const tabs = ["response", "design", "modes", "load", "basins", "shake"];
const show = async (tab) => {
    await page.locator(`#tab-${tab}`).click();
    await ready(page);
};

test("whatever has the focus has a name and a role on every tab", async () => {
    const groups = page.locator("#groups details");
    const opened = await groups.evaluateAll((list) => list.map((own) => own.open));
    await groups.evaluateAll((list) => list.forEach((own) => (own.open = true)));
    for (const tab of tabs) {
        await show(tab);
        const focusable = (await tree()).filter((node) => node.focusable && node.role !== "RootWebArea");
        assert.ok(focusable.length > 60, `${tab}: ${focusable.length}`);
        const bare = focusable.filter(({ role, name }) => name.trim() === "" || ["generic", "none", "image", undefined].includes(role));
        assert.deepEqual(bare, [], tab);
        // Two controls of one kind with one name cannot be told apart.
        const names = focusable.filter(({ role }) => !["option", "MenuListOption"].includes(role)).map(({ role, name }) => `${role} ${name}`);
        assert.deepEqual(names.filter((own, k) => names.indexOf(own) !== k), [], tab);
    }
    await groups.evaluateAll((list, before) => list.forEach((own, k) => (own.open = before[k])), opened);
    await show("response");
});

test("Tab goes through the page in the order of its parts, and the focus is seen", async () => {
    await page.evaluate(() => document.activeElement.blur());
    await page.locator("header h1").click();
    const seen = [];
    for (let step = 0; step < 150; step++) {
        await page.keyboard.press("Tab");
        const own = await page.evaluate(() => {
            const element = document.activeElement;
            if (element === document.body) return undefined;
            const box = element.getBoundingClientRect();
            const style = getComputedStyle(element);
            const ring = (element instanceof SVGElement && element.querySelector("rect") ? [style, getComputedStyle(element.querySelector("rect"))] : [style]).some((one) => (one.outlineStyle !== "none" && parseFloat(one.outlineWidth) >= 1) || one.stroke !== "none");
            const index = [...document.querySelectorAll("*")].indexOf(element);
            return { name: element.id || element.ariaLabel || element.textContent.trim().slice(0, 30), part: element.closest("header, section, dialog")?.id || element.closest("header")?.tagName, ring, index, inside: box.width > 0 && box.bottom > 0 && box.top < innerHeight && box.right > 0 && box.left < innerWidth };
        });
        if (!own) break;
        seen.push(own);
    }
    assert.ok(seen.length > 40, String(seen.length));
    assert.deepEqual(seen.filter((own) => !own.inside || !own.ring).map((own) => own.name), []);
    assert.ok(seen.every((own, k) => k === 0 || own.index > seen[k - 1].index), JSON.stringify(seen.map((own) => own.name)));
    assert.deepEqual([...new Set(seen.map((own) => own.part))], ["HEADER", "controls", "drawing", "response", "orbit"]);
});

test("the selected point is the value of the response, and the arrow keys change it", async () => {
    const chart = page.locator("#chart-response");
    await chart.focus();
    const value = async () => (await tree()).find((node) => node.role === "slider" && node.name.startsWith("Mean power over"));
    const before = await chart.getAttribute("aria-valuetext");
    assert.match(before, /^1[23]\.?\d* Hz, .*W, period 1, stable/);
    await page.keyboard.press("ArrowRight");
    const after = await chart.getAttribute("aria-valuetext");
    assert.notEqual(after, before);
    const shown = (await value()).text;
    assert.ok(Math.abs(shown - parseFloat(after)) < 1e-3, `${shown} ${after}`);
    await until("orbit-title", new RegExp(`Orbit at ${after.split(" ")[0].slice(0, 5)}`));
    await enter(page.locator("#operating-show"));
});

test("Home and End go to the first and the last tab", async () => {
    await page.locator("#tab-response").focus();
    await page.keyboard.press("End");
    assert.equal(await active(), "tab-shake");
    await page.keyboard.press("Home");
    assert.equal(await active(), "tab-response");
});

test("a control that is hidden, disabled or removed by its own key leaves the focus next to it", async () => {
    // Zoom tools, which the complete range hides.
    await page.locator("#chart-response").focus();
    await page.keyboard.press("+");
    await enter(page.locator("#zoom-out"));
    await page.waitForFunction(() => document.getElementById("zoom-tools").hidden && document.activeElement !== document.body);
    // Undo without a further step.
    await type("stop.tip.gap", "1.1");
    await ready(page);
    await enter(page.locator("#undo"));
    await page.waitForFunction(() => document.getElementById("undo").disabled && !document.activeElement.matches(":disabled, body"));
    await ready(page);
    // A pin that is removed.
    await page.locator("#pin").focus();
    await page.keyboard.press("p");
    await enter(page.getByLabel(/^Unpin/));
    await page.waitForFunction(() => document.querySelectorAll("#pins li").length === 0 && document.activeElement !== document.body);
    // A value that is restored.
    await type("stop.tip.gap", "1.1");
    await ready(page);
    await enter(page.getByLabel("stop.tip.gap: restore the value of the file"));
    await page.waitForFunction(() => document.querySelector("[aria-label='stop.tip.gap, value']").value === "1" && document.activeElement.closest(".control"));
    assert.equal(await field("stop.tip.gap").inputValue(), "1");
    await ready(page);
});

test("Home and End on the response select the ends of the branch", async () => {
    const chart = page.locator("#chart-response");
    await chart.focus();
    const at = async () => parseFloat(await chart.getAttribute("aria-valuetext"));
    await page.keyboard.press("Home");
    const first = await at();
    await page.keyboard.press("End");
    const [from, to] = [await page.locator("#from").inputValue(), await page.locator("#to").inputValue()].map(Number);
    const ends = [first, await at()].sort((a, b) => a - b);
    assert.ok(Math.abs(ends[0] - from) < 0.01 && Math.abs(ends[1] - to) < 0.01, `${ends} of ${from} to ${to}`);
    await enter(page.locator("#operating-show"));
});

test("the selected point gives its value to the key, by its button and by U", async () => {
    const chart = page.locator("#chart-response");
    await page.locator("#over").selectOption("stop.tip.gap");
    await ready(page);
    assert.ok(await page.locator("#selected").isHidden());
    for (const way of ["key", "button"]) {
        await chart.focus();
        for (let k = 0; k < 8; k++) await page.keyboard.press(way === "key" ? "ArrowRight" : "ArrowLeft");
        const use = page.locator("#use");
        const value = (await use.textContent()).match(/^Use ([\d.]+) mm$/)[1];
        const words = await page.locator("#selected-words").textContent();
        assert.ok(/^Selected: [\d.]+ .?m, .*W, period 1, (un)?stable/.test(words), words);
        if (way === "key") await page.keyboard.press("u");
        else await enter(use);
        await page.waitForFunction((due) => document.querySelector("[aria-label='stop.tip.gap, value']").value === due, value);
        assert.notEqual(value, "1");
        await page.locator("#selected").waitFor({ state: "hidden" });
        await ready(page);
    }
    await page.locator("#reset").click();
    await page.locator("#over").selectOption("drive.shaker.frequency");
    await ready(page);
});

test("? lists the keys", async () => {
    await page.locator("#chart-response").focus();
    await page.keyboard.press("?");
    const dialog = page.locator("#keys-dialog");
    await dialog.waitFor({ state: "visible" });
    assert.match(await dialog.textContent(), /U\s*set the key of the response to the value of the selected point/);
    await page.keyboard.press("Escape");
    await dialog.waitFor({ state: "hidden" });
});

test("a field whose number gets a slider keeps the focus", async () => {
    await page.locator("summary", { hasText: /^patch/ }).click();
    await field("patch.mfc.strain_limit").focus();
    await page.keyboard.type("400 ppm");
    await page.keyboard.press("Enter");
    await page.getByRole("slider", { name: "patch.mfc.strain_limit", exact: true }).waitFor({ state: "visible" });
    await ready(page);
    assert.equal(await active(), "patch.mfc.strain_limit, value");
    await page.locator("#reset").click();
    await ready(page);
});

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
