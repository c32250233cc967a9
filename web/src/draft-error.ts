// Difference of a draft from the result of its search.

import { type Branch, type ResponseResult, isGap, level } from "./branches";
import { digits } from "./units";

/** Distance at which two curves are the same: a hundredth of the range, or 5 % of the power. */
const SAME = 0.01;
/** Part of the logarithm of the power that counts as much as the same part of the range. */
const WEIGHT = 0.2;

/** Powers below this part of the largest one count as equal: that of a rectifier that hardly conducts is practically 0, so its relative error says nothing. */
const NEGLIGIBLE = 1e-6;

export interface DraftError {
    /** Largest distance of a point of the draft from the result, as a share of the range; `WEIGHT` of it for the logarithm of the power. */
    farthest: number;
    /** Share of the length of the draft that is not on the result, and of the result that is not in the draft. */
    off: number;
    missing: number;
}

/** Places along a line that are compared. */
const PLACES = [0, 0.25, 0.5, 0.75, 1];

/** Drawn lines of the branches of one period, from each point to the next: the ends of both coordinates. */
type Lines = Map<number, [number, number, number, number][]>;

function lines(result: ResponseResult, span: number, least: number): Lines {
    const all: Lines = new Map();
    for (const branch of result.branches) {
        const own = all.get(branch.period) ?? [];
        all.set(branch.period, own);
        const gap = isGap(result, branch);
        const at = (k: number): [number, number] => [branch.x[k] / span, WEIGHT * level(Math.max(branch.values.power[k], least))];
        for (let k = 0; k + 1 < branch.x.length; k++) if (!gap(k)) own.push([...at(k), ...at(k + 1)]);
    }
    return all;
}

/** Distance of a point from the nearest line. */
function distance(x: number, y: number, others: [number, number, number, number][]): number {
    let least = Infinity;
    for (const [a, b, c, d] of others) {
        if (Math.min(a, c) - x > least || x - Math.max(a, c) > least) continue;
        const size = (c - a) ** 2 + (d - b) ** 2;
        const share = size > 0 ? Math.min(Math.max(((x - a) * (c - a) + (y - b) * (d - b)) / size, 0), 1) : 0;
        least = Math.min(least, Math.hypot(a + share * (c - a) - x, b + share * (d - b) - y));
    }
    return least;
}

/** Share of the length of some lines that is not on others, and the largest distance of a point of them. */
function strays(all: Lines, others: Lines): { off: number; farthest: number } {
    let [sum, off, farthest] = [0, 0, 0];
    for (const [period, own] of all) {
        const same = others.get(period) ?? [];
        for (const [a, b, c, d] of own) {
            const length = Math.hypot(c - a, d - b);
            sum += length;
            for (const share of PLACES) {
                const away = distance(a + share * (c - a), b + share * (d - b), same);
                if (away > SAME) off += length / PLACES.length;
                if (Number.isFinite(away)) farthest = Math.max(farthest, away);
            }
        }
    }
    return { off: sum > 0 ? off / sum : 0, farthest };
}

/** Compares a draft with the result of its search; undefined where neither has a power to compare. */
export function draftError(draft: ResponseResult, result: ResponseResult, span: number): DraftError | undefined {
    const powers = [draft, result].flatMap(({ branches }) => branches.flatMap(({ values }: Branch) => [...values.power]));
    const largest = powers.reduce((most, power) => Math.max(most, power), 0);
    if (largest === 0) return undefined;
    const [own, due] = [lines(draft, span, NEGLIGIBLE * largest), lines(result, span, NEGLIGIBLE * largest)];
    return { ...strays(own, due), missing: strays(due, own).off };
}

/** A share, rounded up to two digits. */
function share(value: number): string {
    const unit = 10 ** (Math.floor(Math.log10(100 * value)) - 1);
    return `${value > 0 ? digits(Math.ceil((100 * value) / unit) * unit, 2) : 0} %`;
}

/** A largest distance in words. */
export const distanceWords = (distance: number): string => `${share(distance)} of the range or ${share(Math.expm1(distance / WEIGHT))} of the power`;

/** A sentence about a draft and its search. */
export function errorWords({ farthest, off, missing }: DraftError): string {
    const more = [off >= 0.005 ? `${share(off)} of it was not confirmed` : "", missing >= 0.005 ? `it lacked ${share(missing)} of the curves` : ""].filter(Boolean);
    return `The last draft was off by at most ${distanceWords(farthest)}${more.map((own) => `; ${own}`).join("")}.`;
}
