// What the page says of the error of a draft, before and after its search, against a comparison of the frames of the server.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { browse, open, ready, serve } from "./browser.mjs";
import { compare, draws, holds } from "./curves.mjs";

let server;
let browser;
let page;
before(async () => {
    server = await serve();
    browser = await browse();
    page = await open(browser.context, server.address, record);
    await storeWords();
});
after(async () => {
    await browser?.close();
    await server?.close();
});

/** Keeps the last frame of each stage of the response. */
function record() {
    window.stages = {};
    const Real = window.WebSocket;
    window.WebSocket = class extends Real {
        set onmessage(hear) {
            super.onmessage = (event) => {
                const length = new DataView(event.data).getUint32(0, true);
                const head = JSON.parse(new TextDecoder().decode(new Uint8Array(event.data, 4, length)));
                const list = (name) => head.arrays.filter(([own]) => own === name).flatMap(([, first, size]) => [...new Float64Array(event.data, 4 + length + 8 * first, size)]);
                if (head.ask === "response" && head.branches) window.stages[head.stage] = { id: head.id, draft: head.draft, branches: head.branches.map(({ period }, k) => ({ period, x: list(`${k}.x`), power: list(`${k}.power`), error: list(`${k}.error`) })) };
                hear(event);
            };
        }
    };
}

/** Stores the words of each draft: they appear once the server has placed the ring. */
const storeWords = () => page.evaluate(() => new MutationObserver(() => {
    const words = document.getElementById("readout").textContent;
    if (/^Draft.*: lines within/.test(words)) window.stages.words = words;
}).observe(document.getElementById("readout"), { childList: true, characterData: true, subtree: true }));

for (const gap of ["1.05", "1.6", "4", "7.8"]) {
    test(`the error of the draft at a gap of ${gap} mm`, async () => {
        const field = page.getByLabel("stop.tip.gap, value", { exact: true });
        await field.fill(gap);
        await field.press("Enter");
        await ready(page);
        const { coarse, fine, words: draft } = await page.evaluate(() => window.stages);
        assert.equal(coarse.id, fine.id);
        const due = compare(coarse.branches.map((branch) => ({ ...branch, drawn: draws(branch, coarse.draft) })), fine.branches, 14.82 - 11.44);
        assert.ok(holds(due, coarse.draft), `${JSON.stringify(due)} ${JSON.stringify(coarse.draft)}`);
        const said = draft.match(/^Draft.*: lines within ([\d.e-]+) % of the range or ([\d.e-]+) % of the power;.* curves may be missing until the search ends\./) ?? assert.fail(draft);
        for (const [shown, value] of [[said[1], 100 * coarse.draft.error], [said[2], 100 * Math.expm1(5 * coarse.draft.error)]]) assert.ok(Number(shown) >= value * (1 - 1e-12) && Number(shown) < 1.11 * value, draft);
        const words = await page.locator("#draft-words").textContent();
        const [, range, power, rest] = words.match(/The last draft was off by at most ([\d.e-]+) % of the range or ([\d.e-]+) % of the power(.*?)\./) ?? assert.fail(words);
        const about = (shown, value) => assert.ok(Math.abs(shown - value) < 0.12 * value + 1e-3, `${words} ${JSON.stringify(due)}`);
        about(Number(range), 100 * due.farthest);
        about(Number(power), 100 * Math.expm1(5 * due.farthest));
        const share = (pattern) => Number(rest.match(pattern)?.[1] ?? 0) / 100;
        for (const [shown, value] of [[share(/([\d.]+) % of it was not confirmed/), due.off], [share(/lacked ([\d.]+) % of the curves/), due.missing]]) {
            assert.ok(Math.abs(shown - value) < 0.03, `${words} ${JSON.stringify(due)}`);
        }
    });
}

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
