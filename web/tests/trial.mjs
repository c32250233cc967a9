// Results of the page against the program: `node web/tests/trial.mjs [minutes] [seed] [spec...]`, with the release build. Random designs and
// moves over six specs, one of each in turn. The branches of each finished search are compared with `jounce branch`, the attractors of the
// operating point with `jounce basins`, and each draft with its result: it must be no farther off than it says. The page also starts from the orbits of the design before: what `jounce branch` lacks then
// is compared with a search from more seeds. The exit status is 1 where a result differs. Not part of the tests: it runs as long as it may.
import { browse } from "./browser.mjs";
import { compare, holds } from "./curves.mjs";
import { OPTIONS, SPECS, attractors, branches, comparable, nameOf, ofProgram, walk } from "./designs.mjs";

const minutes = Number(process.argv[2] ?? 20);
const seed = Number(process.argv[3] ?? 1);
const wanted = process.argv.slice(4);
/** Seeds of the search for what the first one lacks. */
const MORE_SEEDS = 60;
/** Starts of the operating point. */
const STARTS = 100;
/** Share of a length that is not counted: the comparison samples the curves. */
const NONE = 0.001;

const percent = (share) => `${(100 * share).toFixed(1)} %`;

const NOTHING = { designs: 0, refused: 0, late: 0, missing: 0, more: 0, unconfirmed: 0, attractors: 0, held: 0, cut: 0, drafts: [] };

/** Compares the branches of a design. */
async function compareBranches({ spec, span }, set, fine, found, words) {
    const width = span.to - span.from;
    const quantity = comparable(fine);
    const shown = branches(fine, quantity);
    const due = await ofProgram(spec, set, span, quantity);
    if (!due) return void (found.late = 1);
    const { off, missing } = compare(shown, due, width);
    found.missing = Number(missing > NONE);
    if (found.missing) words.push(`${percent(missing)} of jounce branch is missing`);
    if (off <= NONE) return;
    const more = await ofProgram(spec, set, span, quantity, MORE_SEEDS);
    const left = more ? compare(shown, more, width).off : 0;
    found.more = 1;
    found.late = Number(!more);
    found.unconfirmed = Number(left > NONE);
    words.push(`${percent(off)} is not in jounce branch, ${more ? percent(left) : "?"} not with ${MORE_SEEDS} seeds`);
}

/** Compares one design; the fields count what differs. */
async function check(own) {
    const { spec, ask, span, move, forget } = own;
    const { set, key, size } = move();
    const found = { ...NOTHING, designs: 1 };
    const words = [`${size} move of ${key}`];
    const frames = await ask("response", { set, ...span, ...OPTIONS }, ["coarse", "fine"]);
    const fault = frames.find(({ head }) => head.stage === "fault");
    if (fault) {
        forget(key);
        return { ...found, refused: 1, words: `${key}: ${fault.head.faults[0].message}` };
    }
    const [coarse, fine] = frames;
    await compareBranches(own, set, fine, found, words);
    const point = await attractors(spec, ask, set, STARTS);
    found.attractors = Number(point.due !== undefined && point.shown !== point.due);
    if (point.due === undefined) found.late = 1;
    if (found.attractors) words.push(`attractors ${point.shown} | ${point.due}`);
    const draft = compare(branches(coarse), branches(fine), span.to - span.from);
    found.drafts = [draft];
    found.held = Number(holds(draft, coarse.head.draft));
    // A search that has spent its budget lacks curves that a draft may have.
    found.cut = Number(!found.held && fine.head.branches.some(({ endings }) => endings.some(({ how }) => how === "points")));
    if (!found.held) words.push(`the draft is off by ${draft.farthest.toFixed(5)} and says ${coarse.head.draft.error}, ${percent(draft.off)} is off${found.cut ? "; the search has spent its budget" : ""}`);
    if (found.missing + found.more + found.attractors > 0 || !found.held) words.push(`set ${JSON.stringify(set)}`);
    return { ...found, words: words.join("; ") };
}

const browser = await browse();
const walks = [];
for (const spec of SPECS.filter((own) => wanted.length === 0 || wanted.some((name) => nameOf(own).includes(name)))) walks.push(await walk(spec, browser, seed));
const sums = walks.map(() => ({ ...NOTHING }));
const end = performance.now() + 60_000 * minutes;
for (let turn = 0; performance.now() < end; turn++) {
    const own = turn % walks.length;
    const began = performance.now();
    const { words, ...found } = await check(walks[own]);
    for (const [name, value] of Object.entries(found)) sums[own][name] = name === "drafts" ? [...sums[own].drafts, ...value] : sums[own][name] + value;
    console.log(`${turn} ${walks[own].name}: ${words}; ${((performance.now() - began) / 1000).toFixed(1)} s`);
}
const most = (list, name) => percent(Math.max(0, ...list.map((own) => own[name])));
walks.forEach(({ name }, k) => {
    const { designs, refused, late, missing, more, unconfirmed, attractors: differ, held, cut, drafts } = sums[k];
    console.log(`${name}: ${designs} designs, ${refused} refused, ${late} not all compared; ${missing} lack a part of jounce branch, ${more} have more than it, ${unconfirmed} more than ${MORE_SEEDS} seeds find, ${differ} differ from jounce basins; of ${drafts.length} drafts ${held} are as near as they say and ${cut} are not decided, off up to ${most(drafts, "off")}, missing up to ${most(drafts, "missing")}`);
});
for (const { close } of walks) await close();
await browser.close();
process.exit(sums.some(({ missing, unconfirmed, attractors: differ, held, cut, drafts }) => missing + unconfirmed + differ + drafts.length - held - cut > 0) ? 1 : 0);
