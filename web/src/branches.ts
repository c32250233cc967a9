// Data of a response: branches, bifurcations, the linear harvester.

import type { Frame } from "./frame";
import { withoutRoundoff } from "./units";
import type { Request } from "./wire";

export type Quantity = "power" | "voltage" | "penetration" | "force" | "impact" | "displacement" | "strain" | "floquet";

export const QUANTITIES: Record<Quantity, { words: string; unit: string }> = {
    power: { words: "Mean power", unit: "W" },
    voltage: { words: "Voltage, rms", unit: "V" },
    penetration: { words: "Penetration, peak", unit: "m" },
    force: { words: "Contact force, peak", unit: "N" },
    impact: { words: "Impact speed, largest", unit: "m/s" },
    strain: { words: "Strain, peak", unit: "ppm" },
    displacement: { words: "Amplitude at the stop", unit: "m" },
    floquet: { words: "Largest multiplier", unit: "" },
};

/** Words and unit of a quantity of a response. */
export function described(quantity: Quantity, { storage }: ResponseResult): { words: string; unit: string } {
    return quantity === "voltage" && storage ? { words: "Storage voltage, rms", unit: "V" } : QUANTITIES[quantity];
}

export interface Branch {
    /** Number that the branch retains in the next response. */
    identity: number;
    period: number;
    x: Float64Array;
    /** Values of each quantity; those of the strain are empty until they are requested. */
    values: Record<Quantity, Float64Array>;
    contacts: Float64Array;
    /** Of a draft: largest distance of each line between two points from its curve; empty for a searched result. */
    error: Float64Array;
}

export interface Bifurcation extends Record<Exclude<Quantity, "strain">, number> {
    branch: number;
    kind: string;
    x: number;
    /** Estimated error of `x`; null where it is not known. */
    error: number | null;
    contacts: number;
}

export interface ResponseResult {
    id: number;
    /** Signature of its design. */
    design: string;
    over: string;
    unit: string;
    branches: Branch[];
    bifurcations: Bifurcation[];
    linear: { x: Float64Array; power: Float64Array };
    /** True where the voltage is that of the storage of a rectified circuit. */
    storage: boolean;
    /** How the branches of a running search were found; undefined for its result. */
    draft: Draft | undefined;
    /** Branches that the search may miss. */
    note: string;
    /** Branches that the search has left for lack of budget. */
    budgetNote: string;
}

/** Branches before the search has ended: `first` for the harvester without contact alone. */
export interface Draft {
    origin: "first" | "updated" | "continued" | "settled";
    lost_share: number;
    /** Largest distance of a drawn line from its curve, on the scale of `away`; lines with a larger error are not drawn. */
    error: number | null;
}

export interface Place {
    branch: number;
    point: number;
}

/** Reads the frame of a response. */
export function resultOf(frame: Frame, { design }: Request): ResponseResult {
    const { head } = frame;
    const branches = (head.branches as { period: number }[]).map((branch, k): Branch => {
        const values = Object.fromEntries(Object.keys(QUANTITIES).map((name) => [name, frame.array(`${k}.${name}`)])) as Branch["values"];
        // Diodes that do not conduct.
        for (const name of ["power", "voltage"] as const) values[name] = values[name].map(withoutRoundoff);
        return { identity: k, period: branch.period, x: frame.array(`${k}.x`), values, contacts: frame.array(`${k}.contacts`), error: frame.array(`${k}.error`) };
    });
    const linear = { x: frame.array("linear.x"), power: frame.array("linear.power") };
    return { id: head.id, design, over: head.over, unit: head.unit, branches, bifurcations: head.bifurcations, linear, storage: head.storage, draft: head.stage === "first" ? { origin: "first", lost_share: 1, error: null } : head.draft ?? undefined, note: head.note ?? "", budgetNote: head.budget_note ?? "" };
}

/** Whether the line from a point of a branch to the next is not drawn: a draft does not know its curve there. */
export const isGap = ({ draft }: ResponseResult, { error }: Branch) => (from: number): boolean => draft !== undefined && !(draft.error !== null && error[from] <= draft.error);

export const isStable = (branch: Branch, point: number): boolean => branch.values.floquet[point] < 1;

/** Gives each branch the number of the nearest branch of the previous response, or a new one. */
export function identify(before: ResponseResult, result: ResponseResult, span: number): void {
    const free = new Set(before.branches.keys());
    let next = Math.max(-1, ...before.branches.map((branch) => branch.identity)) + 1;
    const pairs = result.branches.flatMap((branch, k) =>
        before.branches.map((old, index) => ({ k, index, away: branch.period === old.period ? distance(branch, old, span) : Infinity })),
    );
    const found = new Map<number, number>();
    for (const { k, index, away } of pairs.sort((a, b) => a.away - b.away)) {
        if (away > 1 || found.has(k) || !free.has(index)) continue;
        free.delete(index);
        found.set(k, before.branches[index].identity);
    }
    result.branches.forEach((branch, k) => (branch.identity = found.get(k) ?? next++));
}

/** Mean distance of some points of a branch from another one. */
function distance(branch: Branch, other: Branch, span: number): number {
    const step = Math.max(1, Math.floor(branch.x.length / 8));
    let [sum, count] = [0, 0];
    for (let point = 0; point < branch.x.length; point += step, count++) {
        let least = Infinity;
        for (let k = 0; k < other.x.length; k++) least = Math.min(least, away(other, k, branch.x[point], branch.values.power[point], span));
        sum += least;
    }
    return sum / count;
}

/** Logarithm of a power; finite for a harvester without a load, whose power is 0. */
export const level = (power: number): number => Math.log(Math.max(power, Number.MIN_VALUE));

/** Distance of a point of a branch from a value of the key and a power. */
function away(branch: Branch, point: number, x: number, power: number, span: number): number {
    return Math.hypot((branch.x[point] - x) / span, 0.2 * (level(branch.values.power[point]) - level(power)));
}

/** A stable point next to a value of the key: of the branch of a number, or else of the largest power. */
export function stablePlace(result: ResponseResult, x: number, identity: number | undefined): Place | undefined {
    const found: (Place & { isSame: boolean; power: number })[] = [];
    result.branches.forEach((own, branch) => {
        for (let from = 0; from + 1 < own.x.length; from++) {
            const share = (x - own.x[from]) / (own.x[from + 1] - own.x[from]);
            if (!(share >= 0 && share <= 1)) continue;
            const point = share < 0.5 ? from : from + 1;
            if (isStable(own, point)) found.push({ branch, point, isSame: own.identity === identity, power: own.values.power[point] });
        }
    });
    const [first] = found.sort((a, b) => Number(b.isSame) - Number(a.isSame) || b.power - a.power);
    return first && { branch: first.branch, point: first.point };
}

/** Value of the key and of a quantity between a point of a branch and one of its neighbours. */
export function pointAt({ x, values }: Branch, point: number, at: number, name: Quantity): [number, number] {
    const share = (other: number) => (at - x[point]) / (x[other] - x[point]);
    const other = [point - 1, point + 1].find((own) => share(own) >= 0 && share(own) <= 1);
    const y = values[name];
    return other === undefined ? [x[point], y[point]] : [at, y[point] + share(other) * (y[other] - y[point])];
}

/** Value of a quantity at a bifurcation: that of its orbit, or that of the strain between the points of its branch. */
export function valueAt(found: Bifurcation, name: Quantity, { branches }: ResponseResult, span: number): number {
    if (name !== "strain") return found[name];
    const branch = branches[found.branch];
    const strain = branch.values.strain;
    const on = (k: number): [number, number] => [(branch.x[k] - found.x) / span, 0.2 * (level(branch.values.power[k]) - level(found.power))];
    let [least, value] = [Infinity, Number.NaN];
    for (let k = 0; k + 1 < strain.length; k++) {
        const [[a, b], [c, d]] = [on(k), on(k + 1)];
        const size = (c - a) ** 2 + (d - b) ** 2;
        const share = size > 0 ? Math.min(Math.max(-(a * (c - a) + b * (d - b)) / size, 0), 1) : 0;
        const away = Math.hypot(a + share * (c - a), b + share * (d - b));
        if (away < least) [least, value] = [away, strain[k] + share * (strain[k + 1] - strain[k])];
    }
    return value;
}
