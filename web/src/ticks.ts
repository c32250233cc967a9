// Lines and labels of a logarithmic axis.

/** Ratio of the ends of a logarithmic axis below which it has the steps of a linear one. */
const NARROW = 4;

/** Positions of the lines of a logarithmic grid: 1 to 9 in each decade, only 1 over many decades. */
export function decades(low: number, high: number): number[] {
    if (high / low < NARROW) return steps(low, high);
    const factors = high / low > 1e4 ? [1] : [1, 2, 3, 4, 5, 6, 7, 8, 9];
    const found: number[] = [];
    for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); power++) {
        for (const factor of factors) {
            const place = Number(`${factor}e${power}`);
            if (place >= low && place <= high) found.push(place);
        }
    }
    return found;
}

/** Multiples of 1, 2 or 5 times a power of ten, about five of them. */
function steps(low: number, high: number): number[] {
    const wanted = (high - low) / 5;
    const ten = 10 ** Math.floor(Math.log10(wanted));
    const size = [1, 2, 5, 10].map((factor) => factor * ten).find((step) => step >= wanted)!;
    return Array.from({ length: Math.floor(high / size) - Math.ceil(low / size) + 1 }, (_, k) => (Math.ceil(low / size) + k) * size);
}

/** Values of a logarithmic axis that have a label where so many labels fit, at least two if there are two: 1, 2 and 5 of each decade, or 1 alone. */
export function labelled(values: number[], [low, high]: [number, number], room: number): number[] {
    if (high / low < NARROW) return values;
    const nearest = Math.log(high / low) / room;
    const mantissa = (value: number) => Math.round((1e6 * value) / 10 ** Math.floor(Math.log10(value) + 1e-9)) / 1e6;
    const [many, few] = [[1, 2, 5], [1]].map((own) => values.filter((value) => own.includes(mantissa(value))));
    const fits = (own: number[]) => own.length > 1 && own.every((value, k) => k === 0 || Math.log(value / own[k - 1]) >= nearest);
    const complete = [many, few].find(fits);
    return complete ?? [few, many, values].map((own) => apart(own, nearest)).find((own) => own.length > 1) ?? values.slice(0, 1);
}

/** Values without those that are too near to the one before. */
function apart(values: number[], nearest: number): number[] {
    const found: number[] = [];
    for (const value of values) if (found.length === 0 || Math.log(value / found[found.length - 1]) >= nearest) found.push(value);
    return found;
}
