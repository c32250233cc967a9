// Drafts against searched responses: `node web/tests/drafts.mjs [designs of each spec] [spec...]`, with the release build. Small and large
// moves of random numbers over six specs. For each draft: the share of its length that the search does not confirm, the share of the
// searched length that it misses, and whether what it says of both holds. Every tenth design is compared with `jounce branch` and
// `jounce basins`. Not part of the tests: it takes an hour.
import { execFile } from "node:child_process";
import { promisify } from "node:util";
import { browse, program, serve } from "./browser.mjs";
import { compare, draws } from "./curves.mjs";

const run = promisify(execFile);
const count = Number(process.argv[2] ?? 50);
const SPECS = [
    {}, { kind: "cantilever-with-stop" }, { example: "two-beams-vijayan-2015/harvester.toml" }, { example: "driving-beam-gu-2011/harvester.toml" },
    { example: "bouncing-and-impact-oscillators/impact.toml" }, { kind: "bimorph-with-rectifier" },
];
/** Keys that are moved. */
const MOVED = /^(stop\..*\.gap|beam\..*\.(thickness|length)|drive\..*\.amplitude|circuit\..*resistance|mass\..*\.mass)$/;
const OPTIONS = { longest_period: 2, seeds: 6, tolerance: 1e-9 };

/** Random numbers that are the same each time. */
function random(seed) {
    let state = seed;
    return () => {
        state = (state * 1664525 + 1013904223) % 4294967296;
        return state / 4294967296;
    };
}

/** Opens a socket in the page, as the page itself does. */
async function connect(page, address) {
    await page.addInitScript(() => {
        window.Socket = window.WebSocket;
        window.WebSocket = class {};
    });
    await page.goto(address);
    await page.evaluate(async () => {
        const socket = new window.Socket(`${location.href.replace("http", "ws")}socket`);
        socket.binaryType = "arraybuffer";
        const waits = [];
        socket.onmessage = ({ data }) => {
            const length = new DataView(data).getUint32(0, true);
            const head = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
            const lists = Object.fromEntries(head.arrays.map(([name, first, size]) => [name, [...new Float64Array(data, 4 + length + 8 * first, size)]]));
            for (const own of waits) if (own.id === head.id && (own.stage === head.stage || head.stage === "fault")) own.resolve({ head, lists });
        };
        await new Promise((resolve) => (socket.onopen = resolve));
        let id = 0;
        /** Sends a request and waits for the frames of these stages. */
        window.ask = (ask, body, stages) => {
            id++;
            const frames = stages.map((stage) => new Promise((resolve) => waits.push({ id, stage, resolve })));
            socket.send(JSON.stringify({ id, ask, ...body }));
            return Promise.all(frames);
        };
    });
    return (ask, body, stages) => page.evaluate(([...words]) => window.ask(...words), [ask, body, stages]);
}

/** The branches of a frame of the page. */
const branches = ({ head, lists }) => head.branches.map(({ period }, k) => ({ period, x: lists[`${k}.x`], power: lists[`${k}.power`] }));
/** Those of `jounce branch`. */
const ofProgram = (result) => result.branches.map((branch) => ({ period: branch.period_cycles, x: branch.points.map((own) => own.parameter), power: branch.points.map((own) => own.mean_power_w) }));
const words = (pairs) => pairs.flatMap(([key, value]) => ["--set", `${key}=${value}`]);

async function againstProgram(server, ask, set, span, fine, note) {
    const over = `${span.over}=${span.from}Hz:${span.to}Hz`;
    const options = ["--seeds", String(OPTIONS.seeds), "--longest-period", String(OPTIONS.longest_period), "--tolerance", String(OPTIONS.tolerance)];
    const { stdout } = await run(program, ["branch", server.spec, "--over", over, ...options, "--json", ...words(set)], { maxBuffer: 1 << 28 });
    const due = ofProgram(JSON.parse(stdout));
    const result = compare(branches(fine), due, span.to - span.from);
    note(`  jounce branch: ${(100 * result.off).toFixed(1)} % of the page's length is not in it, ${(100 * result.missing).toFixed(1)} % of its length is not on the page`);
    const [point] = await ask("operating-point", { set, starts: 100 }, ["done"]);
    const basins = JSON.parse((await run(program, ["basins", server.spec, "--starts", "100", "--json", ...words(set)], { maxBuffer: 1 << 28 })).stdout);
    const list = (own) => own.attractors.map((one) => `${one.id} ${one.mean_power_w} ${one.fraction}`).join("; ");
    note(`  jounce basins: ${point.head.stage === "fault" ? point.head.faults[0].message : list(point.head) === list(basins) ? "the same" : `differs: ${list(point.head)} | ${list(basins)}`}`);
}

async function measure(spec, browser, results) {
    const server = await serve(spec);
    const page = await browser.context.newPage();
    const ask = await connect(page, server.address);
    const [{ head }] = await ask("design", { set: [] }, ["done"]);
    const next = random(1);
    const keys = head.controls.filter(({ key, value }) => MOVED.test(key) && value > 0);
    const frequency = head.controls.find(({ key }) => /^drive\..*\.frequency$/.test(key));
    const span = { over: frequency.key, from: 0.88 * frequency.value, to: 1.14 * frequency.value };
    console.log(`${JSON.stringify(spec)}: ${keys.map(({ key }) => key).join(", ")}`);
    const values = new Map();
    for (let k = 0; k < count; k++) {
        const key = keys[Math.floor(next() * keys.length)];
        const isLarge = next() < 0.4;
        const old = values.get(key.key) ?? key.value;
        const factor = isLarge ? 0.5 + next() : 1 + 0.06 * (next() - 0.5);
        values.set(key.key, isLarge ? key.value * factor : old * factor);
        const set = [...values].map(([name, value]) => {
            const control = head.controls.find((own) => own.key === name);
            return [name, `${value / control.factor} ${control.unit}`.trim()];
        });
        const began = performance.now();
        const [coarse, fine] = await ask("response", { set, ...span, ...OPTIONS }, ["coarse", "fine"]);
        if (coarse.head.stage === "fault" || fine.head.stage === "fault") {
            console.log(`  ${k} ${key.key}: ${(coarse.head.faults ?? fine.head.faults)[0].message}`);
            values.delete(key.key);
            continue;
        }
        const shown = branches(coarse).map((branch) => ({ ...branch, drawn: draws(branch) }));
        const result = { ...compare(shown, branches(fine), span.to - span.from), ...coarse.head.draft, move: isLarge ? "large" : "small" };
        results.push(result);
        console.log(`  ${k} ${result.move} ${result.origin} lost ${(100 * result.lost_share).toFixed(1)} %: off ${(100 * result.off).toFixed(1)} %, missing ${(100 * result.missing).toFixed(1)} %, largest distance ${result.farthest.toFixed(4)}; ${coarse.head.ms.toFixed(0)} ms, ${((performance.now() - began) / 1000).toFixed(1)} s`);
        if (k % 10 === 0) await againstProgram(server, ask, set, span, fine, (line) => console.log(line));
    }
    await page.close();
    await server.close();
}

const browser = await browse();
const results = [];
const wanted = process.argv.slice(3);
for (const spec of SPECS) {
    if (wanted.length > 0 && !wanted.some((name) => (spec.example ?? spec.kind ?? "paper").includes(name))) continue;
    await measure(spec, browser, results);
}
const quantile = (list, share) => [...list].sort((a, b) => a - b)[Math.min(list.length - 1, Math.floor(share * list.length))] ?? 0;
for (const group of ["updated", "continued", "settled"]) {
    const own = results.filter((result) => result.origin === group);
    const row = (name, list) => `${name}: median ${(100 * quantile(list, 0.5)).toFixed(1)} %, 95th percentile ${(100 * quantile(list, 0.95)).toFixed(1)} %, most ${(100 * quantile(list, 1)).toFixed(1)} %`;
    console.log(`${own.length} drafts ${group}. ${row("off", own.map((one) => one.off))}; ${row("missing", own.map((one) => one.missing))}; missing beyond what is lost: ${row("", own.map((one) => Math.max(0, one.missing - one.lost_share)))}`);
}
await browser.close();
