// Results of the page against the program, for drawn designs and moves of six specs. The branches of each finished search are compared with
// `jounce branch`, the attractors of the operating point with `jounce basins`, and each draft with its search: it must be no farther off than
// it says. The page also starts from the orbits of the design before: what `jounce branch` lacks is compared with a search from more seeds.
// A search that says that it is incomplete, on the page or of the program, decides nothing where the two differ; such designs are counted.
// JOUNCE_DRAWN_DESIGNS is the number of designs of all specs together, JOUNCE_DRAWN_SEED the seed of their random numbers.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { browse } from "./browser.mjs";
import { compare, holds } from "./curves.mjs";
import { OPTIONS, SPECS, attractors, branches, comparable, isCut, nameOf, ofProgram, walk } from "./designs.mjs";

const count = Number(process.env.JOUNCE_DRAWN_DESIGNS ?? SPECS.length);
const seed = Number(process.env.JOUNCE_DRAWN_SEED ?? 1);
/** Seeds of the search for what the first one lacks. */
const MORE_SEEDS = 60;
/** Starts of the operating point. */
const STARTS = 100;
/** Share of a length that is not counted: the comparison samples the curves. */
const NONE = 0.001;
/** Share of the drafts of which the stated error must hold. */
const HELD = 0.99;

const percent = (share) => `${(100 * share).toFixed(1)} %`;

/** Compares the branches of a search with `jounce branch`; says what differs, and counts it. */
async function compareBranches({ spec, span }, set, fine, found) {
    const width = span.to - span.from;
    const quantity = comparable(fine);
    const shown = branches(fine, quantity);
    const due = await ofProgram(spec, set, span, quantity);
    if (!due?.branches) {
        if (due) found.differs.push(`jounce branch: ${due.fault}`);
        found.late = Number(!due);
        return;
    }
    const { off, missing } = compare(shown, due.branches, width);
    if (missing > NONE) found[isCut(fine) ? "open" : "differs"].push(`${percent(missing)} of jounce branch is missing`);
    if (off <= NONE) return;
    const more = await ofProgram(spec, set, span, quantity, MORE_SEEDS);
    const left = more?.branches ? compare(shown, more.branches, width).off : 0;
    found.more = 1;
    found.late = Number(!more?.branches);
    if (left > NONE) found[more.isCut || isCut(fine) ? "open" : "differs"].push(`${percent(left)} is not in jounce branch with ${MORE_SEEDS} seeds`);
}

/** Compares a draft with its search. */
function compareDraft({ span }, coarse, fine, found) {
    const draft = compare(branches(coarse), branches(fine), span.to - span.from);
    found.held = holds(draft, coarse.head.draft);
    found.undecided = !found.held && isCut(fine);
    if (!found.held) found.draft = `the draft is off by ${draft.farthest.toFixed(5)} and says ${coarse.head.draft.error}, ${percent(draft.off)} of it is off${found.undecided ? "; the search is incomplete" : ""}`;
}

/** Moves to the next design and compares it. */
async function check(own) {
    const { spec, ask, span, move, forget } = own;
    const { set, key, size } = move();
    const found = { move: `${size} move of ${key}`, set, differs: [], open: [], refused: 0, late: 0, more: 0 };
    const [coarse, fine] = await ask("response", { set, ...span, ...OPTIONS }, ["coarse", "fine"]);
    const fault = [coarse, fine].find(({ head }) => head.stage === "fault");
    if (fault) {
        forget(key);
        const due = await ofProgram(spec, set, span, "power");
        if (due?.branches) found.differs.push(`jounce branch has ${due.branches.length} branches`);
        return { ...found, refused: 1, move: `${found.move}: ${fault.head.faults[0].message}` };
    }
    await compareBranches(own, set, fine, found);
    const point = await attractors(spec, ask, set, STARTS);
    if (point.due === undefined) found.late = 1;
    else if (point.shown !== point.due) found.differs.push(`attractors ${point.shown}, by jounce basins ${point.due}`);
    compareDraft(own, coarse, fine, found);
    return found;
}

/** A line about a design. */
function line({ move, set, differs, open, draft, late }) {
    const found = [...differs, ...open.map((words) => `${words}, of searches of which one is incomplete`), ...(draft ? [draft] : [])];
    const words = [move, ...found, ...(late ? ["not all compared"] : [])];
    return `${words.join("; ")}${found.length > 0 ? `; set ${JSON.stringify(set)}` : ""}`;
}

/** Drafts that the searches decide. */
const decided = (designs) => designs.filter(({ held, undecided }) => held !== undefined && !undecided);
const heldOf = (designs) => decided(designs).filter(({ held }) => held).length;
const draftWords = (designs) => `${heldOf(designs)} of ${decided(designs).length} drafts hold, ${designs.filter(({ undecided }) => undecided).length} are not decided`;

let browser;
before(async () => {
    browser = await browse();
});
after(() => browser?.close());

const all = [];
for (const [index, spec] of SPECS.entries()) {
    const own = Math.floor(count / SPECS.length) + Number(index < count % SPECS.length);
    test(`${own} designs of ${nameOf(spec)}`, async () => {
        const walking = await walk(spec, browser, seed);
        const designs = [];
        for (let number = 0; number < own; number++) {
            designs.push(await check(walking));
            console.log(`${nameOf(spec)} ${number}: ${line(designs[number])}`);
        }
        await walking.close();
        all.push(...designs);
        const sum = (name) => designs.reduce((total, one) => total + one[name], 0);
        console.log(`${nameOf(spec)}: ${own} designs, ${sum("refused")} refused, ${sum("late")} not all compared, ${sum("more")} with more than jounce branch finds from ${OPTIONS.seeds} seeds, ${designs.filter(({ open }) => open.length > 0).length} not decided; ${draftWords(designs)}`);
        assert.deepEqual(designs.flatMap(({ differs }) => differs), []);
        assert.ok(own === 0 || sum("refused") + sum("late") < own, "no design was compared");
    });
}

/** A drawn design with a period doubling at 14.3975 Hz, and a grazing of the doubled branch at 14.387 Hz. */
const NEXT_TO_GRAZING = [
    ["beam.beam.thickness", "0.9841571916546672 mm"], ["circuit.load.resistance", "0.8838595459237695 Mohm"], ["stop.tip.gap", "0.8984922570284826 mm"],
    ["drive.shaker.amplitude", "209.6094357315451 N"], ["beam.beam.length", "360.41498166118214 mm"], ["mass.table.mass", "15.348643288221783 kg"],
];

test("page and program follow a period doubling with a grazing next to it", async () => {
    const { spec, ask, span, close } = await walk({}, browser, seed);
    const [, fine] = await ask("response", { set: NEXT_TO_GRAZING, ...span, ...OPTIONS }, ["coarse", "fine"]);
    const due = await ofProgram(spec, NEXT_TO_GRAZING, span, "power");
    await close();
    // The doubled branch turns back at a fold next to the grazing.
    const doubled = due.branches.filter(({ period }) => period === 2);
    assert.ok(doubled.length === 2 && doubled.some(({ x }) => Math.abs(Math.min(...x) - 14.3856) < 1e-3) && !due.isCut, JSON.stringify(due.branches.map(({ period, x }) => [period, Math.min(...x), Math.max(...x)])));
    assert.deepEqual(compare(branches(fine), due.branches, span.to - span.from).missing, 0);
});

test("what a draft says of its error holds", () => {
    console.log(draftWords(all));
    assert.ok(decided(all).length > 0 && heldOf(all) >= HELD * decided(all).length, draftWords(all));
});
