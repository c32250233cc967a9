// Ranges of the key over which all stable orbits that were found stay below the strain limit.

import { type Branch, type ResponseResult, isStable } from "./branches";
import { stableCounts } from "./stability";
import { digits, quantity } from "./units";

type Span = [number, number];

/** Lines between two points of a branch that have a stable end, and an end above the limit. No part of the range of such a line counts as below. */
function above(branch: Branch, limit: number): Span[] {
    const { x, values: { strain } } = branch;
    const found: Span[] = [];
    for (let k = 0; k + 1 < x.length; k++) {
        if ((isStable(branch, k) || isStable(branch, k + 1)) && (strain[k] > limit || strain[k + 1] > limit)) found.push([Math.min(x[k], x[k + 1]), Math.max(x[k], x[k + 1])]);
    }
    return found;
}

/** What remains of a range without some parts of it. */
function without(range: Span, parts: Span[]): Span[] {
    let left = [range];
    for (const [low, high] of parts) left = left.flatMap(([from, to]): Span[] => (high <= from || low >= to ? [[from, to]] : [[from, low], [high, to]])).filter(([from, to]) => to > from);
    return left;
}

/** Ranges of the key with stable orbits that are all below the limit. */
function rangesBelow(result: ResponseResult, range: Span, limit: number): Span[] {
    const beyond = result.branches.flatMap((branch) => above(branch, limit));
    const stable = stableCounts(result, range).filter(({ orbits }) => orbits > 0);
    const below: Span[] = [];
    for (const [from, to] of stable.flatMap((own) => without([own.from, own.to], beyond))) {
        const last = below[below.length - 1];
        if (last?.[1] === from) last[1] = to;
        else below.push([from, to]);
    }
    return below;
}

/** A sentence about the strain limit, ppm; of a result with strains, where the stable orbits stay below it. */
export function limitWords(result: ResponseResult, range: Span, limit: number): string {
    const words = `The strain limit is ${digits(limit)} ppm`;
    if (result.draft || result.branches.some(({ values }) => values.strain.length === 0)) return `${words}.`;
    const below = rangesBelow(result, range, limit);
    if (below.length === 0) return `${words}; at no value of the key do all stable orbits found stay below it.`;
    const at = (value: number) => quantity(value, result.unit, 5);
    const where = below.length === 1 && below[0][0] === range[0] && below[0][1] === range[1] ? "in the complete range" : below.map(([from, to]) => `from ${at(from)} to ${at(to)}`).join(", ");
    return `${words}; all stable orbits found stay below it ${where}.`;
}
