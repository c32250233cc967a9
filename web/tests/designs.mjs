// Random designs of six specs, and the requests of the page for them: for the trials of drafts and of results.
import { program, serve } from "./browser.mjs";
import { draws } from "./curves.mjs";
import { execFile } from "node:child_process";
import { promisify } from "node:util";

const run = promisify(execFile);
export const SPECS = [
    {}, { kind: "cantilever-with-stop" }, { example: "two-beams-vijayan-2015/harvester.toml" }, { example: "driving-beam-gu-2011/harvester.toml" },
    { example: "bouncing-and-impact-oscillators/impact.toml" }, { kind: "bimorph-with-rectifier" },
];
/** Keys that are moved. */
const MOVED = /^(stop\..*\.gap|beam\..*\.(thickness|length)|drive\..*\.amplitude|circuit\..*resistance|mass\..*\.mass)$/;
export const OPTIONS = { longest_period: 2, seeds: 6, tolerance: 1e-9 };

/** Random numbers that are the same each time. */
function random(seed) {
    let state = seed;
    return () => {
        state = (state * 1664525 + 1013904223) % 4294967296;
        return state / 4294967296;
    };
}

/** Opens a socket in the page, as the page itself does; `window.join` opens further ones, as other pages would. */
export async function connect(page, address) {
    await page.addInitScript(() => {
        window.Socket = window.WebSocket;
        window.WebSocket = class {};
    });
    await page.goto(address);
    await page.evaluate(async () => {
        window.join = async () => {
            const socket = new window.Socket(`${location.href.replace("http", "ws")}socket`);
            socket.binaryType = "arraybuffer";
            const waits = [];
            socket.onmessage = ({ data }) => {
                const at = performance.now();
                const length = new DataView(data).getUint32(0, true);
                const head = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
                const lists = Object.fromEntries(head.arrays.map(([name, first, size]) => [name, [...new Float64Array(data, 4 + length + 8 * first, size)]]));
                for (const own of waits) if (own.id === head.id && (own.stage === head.stage || head.stage === "fault")) own.resolve({ head, lists, at });
            };
            await new Promise((resolve) => (socket.onopen = resolve));
            let id = 0;
            /** Sends a request and waits for the frames of these stages. */
            return (ask, body, stages) => {
                id++;
                const frames = stages.map((stage) => new Promise((resolve) => waits.push({ id, stage, resolve })));
                socket.send(JSON.stringify({ id, ask, ...body }));
                return Promise.all(frames);
            };
        };
        window.ask = await window.join();
    });
    return (ask, body, stages) => page.evaluate(([...words]) => window.ask(...words), [ask, body, stages]);
}

/** Power below which it is roundoff: diodes that do not conduct. */
const ROUNDOFF_W = 1e-21;
/** The quantity of a frame that is compared: a harvester without a load, or whose diodes do not conduct, has no power. */
export const comparable = ({ head, lists }) => (head.branches.some((_, k) => lists[`${k}.power`].some((own) => own > ROUNDOFF_W)) ? "power" : "displacement");
/** The branches of a frame of the page with a quantity; of a draft also which lines are drawn. */
export const branches = ({ head, lists }, quantity = "power") => head.branches.map(({ period }, k) => ({
    period, x: lists[`${k}.x`], power: lists[`${k}.${quantity}`], ...(head.draft && { drawn: draws({ error: lists[`${k}.error`] }, head.draft) }),
}));
const words = (pairs) => pairs.flatMap(([key, value]) => ["--set", `${key}=${value}`]);
/** Far longer than most commands take, also on a busy machine. */
const LONGEST_MS = 180_000;
/** Result of a command of the program for a design; undefined where it takes too long. An incomplete result is printed too, with an exit code of its own. */
async function asked(command, spec, options, set) {
    try {
        return JSON.parse((await run(program, [command, spec, ...options, "--json", ...words(set)], { maxBuffer: 1 << 28, timeout: LONGEST_MS })).stdout);
    } catch (error) {
        if (error.killed) return undefined;
        return error.stdout ? JSON.parse(error.stdout) : { fault: error.stderr.trim() };
    }
}

/** True for the frame of a search that has left branches for lack of budget, or found no first orbit of one; the page says so. */
export const isCut = ({ head }) => head.budget_note !== null || head.branches.some(({ endings }) => endings.some(({ how }) => how === "points"));

/** The branches of `jounce branch` with a quantity, and whether it has left some; or its fault; undefined where it takes too long. */
export async function ofProgram(spec, set, span, quantity, seeds = OPTIONS.seeds) {
    const name = { power: "mean_power_w", displacement: "displacement_peak_m" }[quantity];
    const options = ["--over", `${span.over}=${span.from}Hz:${span.to}Hz`, "--seeds", String(seeds), "--longest-period", String(OPTIONS.longest_period), "--tolerance", String(OPTIONS.tolerance)];
    const result = await asked("branch", spec, options, set);
    const branches = result?.branches?.map((branch) => ({ period: branch.period_cycles, x: branch.points.map((own) => own.parameter), power: branch.points.map((own) => own[name]) }));
    const isCut = result?.branches?.some((branch) => branch.not_followed > 0 || branch.termination.some(({ reason }) => reason === "points"));
    return result && { branches, isCut, fault: result.fault };
}

/** The attractors of `jounce basins`, undefined where it takes too long, and those of the operating point of the page. */
export async function attractors(spec, ask, set, starts) {
    const list = (own) => own.attractors.map((one) => `${one.id} ${one.mean_power_w} ${one.fraction}`).join("; ");
    // The page and the program word a fault differently.
    const words = (own, fault) => (fault ? "fault" : own && list(own));
    const [{ head }] = await ask("operating-point", { set, starts }, ["done"]);
    const due = await asked("basins", spec, ["--starts", String(starts)], set);
    return { due: words(due, due?.fault), shown: words(head, head.stage === "fault") };
}

/** Name of a spec. */
export const nameOf = (spec) => spec.example ?? spec.kind ?? "impact-harvester-2019/harvester.toml";

/** A server on a spec with a page, and the random designs to move it to. */
export async function walk(spec, browser, seed) {
    const server = await serve(spec);
    const page = await browser.context.newPage();
    const ask = await connect(page, server.address);
    const [{ head }] = await ask("design", { set: [] }, ["done"]);
    const next = random(seed);
    const keys = head.controls.filter(({ key, value }) => MOVED.test(key) && value > 0);
    const frequency = head.controls.find(({ key }) => /^drive\..*\.frequency$/.test(key));
    const span = { over: frequency.key, from: 0.88 * frequency.value, to: 1.14 * frequency.value };
    const values = new Map();
    /** Moves to another design: a small step from the last one, or a large one from the spec. */
    const move = () => {
        const key = keys[Math.floor(next() * keys.length)];
        const isLarge = next() < 0.4;
        const old = values.get(key.key) ?? key.value;
        values.set(key.key, isLarge ? key.value * (0.5 + next()) : old * (1 + 0.06 * (next() - 0.5)));
        const set = [...values].map(([name, value]) => {
            const control = keys.find((own) => own.key === name);
            return [name, `${value / control.factor} ${control.unit}`.trim()];
        });
        return { set, key: key.key, size: isLarge ? "large" : "small" };
    };
    const close = async () => {
        await page.close();
        await server.close();
    };
    return { spec: server.spec, name: nameOf(spec), keys, span, ask, move, forget: (key) => values.delete(key), close };
}
