// Data of a response: branches, bifurcations, the linear harvester.

import type { Frame } from "./frame";

export type Quantity = "power" | "voltage" | "penetration" | "floquet";

export const QUANTITIES: Record<Quantity, { words: string; unit: string }> = {
    power: { words: "Mean power", unit: "W" },
    voltage: { words: "Voltage, rms", unit: "V" },
    penetration: { words: "Penetration, peak", unit: "m" },
    floquet: { words: "Largest multiplier", unit: "" },
};

export interface Branch {
    period: number;
    x: Float64Array;
    values: Record<Quantity, Float64Array>;
    contacts: Float64Array;
}

export interface Bifurcation {
    branch: number;
    kind: string;
    x: number;
    contacts: number;
    power: number;
    voltage: number;
    penetration: number;
    floquet: number;
}

export interface ResponseResult {
    id: number;
    over: string;
    unit: string;
    branches: Branch[];
    bifurcations: Bifurcation[];
    linear: { x: Float64Array; power: Float64Array };
}

export interface Place {
    branch: number;
    point: number;
}

/** Reads the frame of a response. */
export function resultOf(frame: Frame): ResponseResult {
    const { head } = frame;
    const branches = (head.branches as { period: number }[]).map((branch, k): Branch => {
        const values = Object.fromEntries(Object.keys(QUANTITIES).map((name) => [name, frame.array(`${k}.${name}`)]));
        return { period: branch.period, x: frame.array(`${k}.x`), values: values as Branch["values"], contacts: frame.array(`${k}.contacts`) };
    });
    const linear = { x: frame.array("linear.x"), power: frame.array("linear.power") };
    return { id: head.id, over: head.over, unit: head.unit, branches, bifurcations: head.bifurcations, linear };
}

export const isStable = (branch: Branch, point: number): boolean => branch.values.floquet[point] < 1;

/** The stable point of the largest power, or any point. */
export function best(result: ResponseResult): Place | undefined {
    let found: Place | undefined;
    let most = -1;
    result.branches.forEach((branch, k) => {
        for (let point = 0; point < branch.x.length; point++) {
            const power = branch.values.power[point] + (isStable(branch, point) ? 1e9 : 0);
            if (power > most) [most, found] = [power, { branch: k, point }];
        }
    });
    return found;
}

/** The point of a new response nearest to a point of an old one. */
export function nearest(result: ResponseResult, x: number, power: number, span: number): Place | undefined {
    let found: Place | undefined;
    let least = Infinity;
    result.branches.forEach((branch, k) => {
        for (let point = 0; point < branch.x.length; point++) {
            const away = Math.hypot((branch.x[point] - x) / span, 0.2 * Math.log(branch.values.power[point] / power));
            if (away < least) [least, found] = [away, { branch: k, point }];
        }
    });
    return found;
}
