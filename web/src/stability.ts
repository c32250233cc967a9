// Numbers of stable orbits over ranges of the key: where one motion alone is possible, and where starts decide.

import { kindOf } from "./bifurcations";
import { type Bifurcation, type ResponseResult, isStable, level } from "./branches";
import type { Head } from "./frame";
import { quantity } from "./units";

/** Width, as a share of the range, below which two ends are one: the corrected points of a bifurcation. */
const SAME = 1e-6;
/** Most ranges that fit into a sentence. */
const FEW = 5;

/** Stability of an orbit in words. */
export function orbitStability({ stable, bifurcation, is_at_stability_limit }: Head): string {
    if (!is_at_stability_limit) return stable ? "stable" : "unstable";
    const kind = kindOf(bifurcation ?? "");
    return `at the stability limit (${kind.isCritical ? kind.words : "a multiplier of modulus 1"})`;
}

export interface Count {
    from: number;
    to: number;
    orbits: number;
}

/** Value of the key at which a branch changes its stability between two points: that of its bifurcation there. */
function changeAt(result: ResponseResult, index: number, from: number, span: number): number {
    const { x, values } = result.branches[index];
    const at = (k: number): [number, number] => [x[k] / span, 0.2 * level(values.power[k])];
    const [[a, b], [c, d]] = [at(from), at(from + 1)];
    // Next to a fold the bifurcation is outside the two values of the key.
    const away = (found: Bifurcation) => Math.hypot(found.x / span - (a + c) / 2, 0.2 * level(found.power) - (b + d) / 2);
    const near = result.bifurcations.filter((found) => found.branch === index && away(found) <= Math.hypot(c - a, d - b)).sort((one, other) => away(one) - away(other));
    return near[0]?.x ?? (x[from] + x[from + 1]) / 2;
}

/** Ranges of the key over which stable parts of branches run in one direction. */
function runs(result: ResponseResult, span: number): [number, number][] {
    const found: [number, number][] = [];
    result.branches.forEach((branch, index) => {
        const { x } = branch;
        let before = 0;
        for (let k = 0; k + 1 < x.length; k++) {
            const [first, second] = [isStable(branch, k), isStable(branch, k + 1)];
            const change = first !== second ? changeAt(result, index, k, span) : Number.NaN;
            const [start, end] = [first ? x[k] : change, second ? x[k + 1] : change];
            const way = first || second ? Math.sign(end - start) : 0;
            const ends: [number, number] = [Math.min(start, end), Math.max(start, end)];
            const last = found[found.length - 1];
            if (way !== 0 && way === before && first) [last[0], last[1]] = [Math.min(last[0], ends[0]), Math.max(last[1], ends[1])];
            else if (way !== 0) found.push(ends);
            before = way;
        }
    });
    return found;
}

/** Number of stable orbits in each range of the key where it does not change. */
export function stableCounts(result: ResponseResult, [from, to]: [number, number]): Count[] {
    const spans = runs(result, to - from);
    const cuts = [from, ...spans.flat().filter((end) => end > from && end < to), to].sort((a, b) => a - b);
    const counts: Count[] = [];
    for (let k = 0; k + 1 < cuts.length; k++) {
        if (cuts[k + 1] - cuts[k] <= SAME * (to - from)) continue;
        const middle = (cuts[k] + cuts[k + 1]) / 2;
        const orbits = spans.filter(([low, high]) => low <= middle && middle <= high).length;
        const last = counts[counts.length - 1];
        if (last?.orbits === orbits) last.to = cuts[k + 1];
        else counts.push({ from: cuts[k], to: cuts[k + 1], orbits });
    }
    return counts;
}

/** A sentence about the stable orbits that the search has found. */
export function stableWords(result: ResponseResult, range: [number, number]): string {
    const counts = stableCounts(result, range);
    const numbers = counts.map(({ orbits }) => orbits);
    if (result.branches.length === 0 || counts.length === 0) return "";
    if (counts.length > FEW) return `Stable orbits found: ${Math.min(...numbers)} to ${Math.max(...numbers)}, by the value of the key.`;
    const own = (orbits: number) => (orbits === 0 ? "no stable periodic orbit" : String(orbits));
    if (counts.length === 1 && numbers[0] === 0) return "No stable periodic orbit was found in the complete range.";
    if (counts.length === 1) return `Stable orbits found: ${numbers[0]} in the complete range.`;
    const words = counts.map(({ to, orbits }, k) => (k + 1 < counts.length ? `${own(orbits)} up to ${quantity(to, result.unit, 5)}` : `then ${own(orbits)}`));
    return `Stable orbits found: ${words.join(", ")}.`;
}
