// Drafts against searched responses: `node web/tests/drafts.mjs [designs of each spec] [spec...]`, with the release build. Small and large
// moves of random numbers over six specs. For each draft: the share of its length that the search does not confirm, the share of the
// searched length that it misses, and whether what it says of both holds. Not part of the tests: it takes an hour.
import { browse } from "./browser.mjs";
import { compare, holds } from "./curves.mjs";
import { OPTIONS, SPECS, branches, nameOf, walk } from "./designs.mjs";

const count = Number(process.argv[2] ?? 50);

async function measure(spec, browser, results) {
    const { ask, span, keys, move, forget, name, close } = await walk(spec, browser, 1);
    console.log(`${name}: ${keys.map(({ key }) => key).join(", ")}`);
    for (let k = 0; k < count; k++) {
        const { set, key, size } = move();
        const began = performance.now();
        const [coarse, fine] = await ask("response", { set, ...span, ...OPTIONS }, ["coarse", "fine"]);
        if (coarse.head.stage === "fault" || fine.head.stage === "fault") {
            console.log(`  ${k} ${key}: ${(coarse.head.faults ?? fine.head.faults)[0].message}`);
            forget(key);
            continue;
        }
        const compared = compare(branches(coarse), branches(fine), span.to - span.from);
        const result = { ...compared, ...coarse.head.draft, move: size, held: holds(compared, coarse.head.draft) };
        results.push(result);
        console.log(`  ${k} ${result.move} ${result.origin} lost ${(100 * result.lost_share).toFixed(1)} %: off ${(100 * result.off).toFixed(1)} %, missing ${(100 * result.missing).toFixed(1)} %, largest distance ${result.farthest.toFixed(4)}, ${result.held ? "" : "not "}within ${result.error?.toFixed(4)}; ${coarse.head.ms.toFixed(0)} ms, ${((performance.now() - began) / 1000).toFixed(1)} s`);
    }
    await close();
}

const browser = await browse();
const results = [];
const wanted = process.argv.slice(3);
for (const spec of SPECS) {
    if (wanted.length > 0 && !wanted.some((name) => nameOf(spec).includes(name))) continue;
    await measure(spec, browser, results);
}
const quantile = (list, share) => [...list].sort((a, b) => a - b)[Math.min(list.length - 1, Math.floor(share * list.length))] ?? 0;
for (const group of ["updated", "continued", "settled"]) {
    const own = results.filter((result) => result.origin === group);
    const row = (name, list) => `${name}: median ${(100 * quantile(list, 0.5)).toFixed(1)} %, 95th percentile ${(100 * quantile(list, 0.95)).toFixed(1)} %, most ${(100 * quantile(list, 1)).toFixed(1)} %`;
    console.log(`${own.length} drafts ${group}, ${own.filter(({ held }) => held).length} held. ${row("off", own.map((one) => one.off))}; ${row("missing", own.map((one) => one.missing))}; missing beyond what is lost: ${row("", own.map((one) => Math.max(0, one.missing - one.lost_share)))}`);
}
await browser.close();
