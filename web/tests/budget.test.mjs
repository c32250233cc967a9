// The sentence about branches that a search did not follow: on the template of a cantilever, whose branches double their period many times.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { browse, open, serve } from "./browser.mjs";

let server;
let browser;
let page;
before(async () => {
    server = await serve({ kind: "cantilever-with-stop" });
    browser = await browse();
    page = await open(browser.context, server.address);
});
after(async () => {
    await browser?.close();
    await server?.close();
});

test("an incomplete search says how many branches were not followed, and how to follow them", async () => {
    const words = await page.locator("#incomplete").textContent();
    assert.match(words, /^Incomplete: (\d+ of \d+ branches (was|were) not followed to the end, and )?the branches of \d+ period doublings? were not followed at all\. /);
    assert.match(words, /A search may use \d+ drive cycles of orbits\. To follow the rest, search a shorter range \(magnify it, then Use as range\), or run jounce branch with a --budget above \d+\.$/);
    assert.ok(await page.locator("#incomplete").isVisible());
    assert.doesNotMatch(await page.locator("#readout").textContent(), /drive cycles of orbits/);
});

test("no sentence of an earlier search stands with a draft", async () => {
    await page.getByLabel("stop.tip.gap, value", { exact: true }).fill("0.31");
    await page.getByLabel("stop.tip.gap, value", { exact: true }).press("Enter");
    await page.waitForFunction(() => /^Draft/.test(document.getElementById("readout").textContent));
    assert.ok(await page.locator("#incomplete").isHidden());
    assert.deepEqual(page.faults, []);
});
