// Values with a label on a logarithmic axis, and the lines of its grid.
//
// The labels are the first of these sets with at least two values that all have room:
// 1. Below 0.7 decades: multiples of a step, 1, 2 or 5 times a power of ten.
// 2. 1, 2 and 5 of each decade; with three powers of ten or more, these must have twice the room.
// 3. Powers of ten; then every second, third, ... of them.
// Where no set has two values with room: the first and the last line of the axis.
// Pictures of the program have the same rule in crates/jounce-plot/src/axis/log_labels.rs; both are tested with crates/jounce-plot/src/axis/cases.json.

/** Span below which a logarithmic axis has equal steps, decades. */
const NARROW = 0.7;
/** Number of equal steps of a narrow axis, at most. */
const MAX_STEPS = 7;
/** Span above which only the powers of ten are lines, decades. */
const WIDE = 4;
/** Rounding of the ends of an axis, relative to a step. */
const ROUNDING = 1e-9;

/** Values that may have labels, and how many times the least distance they must have. */
interface LabelSet {
    values: number[];
    rooms: number;
}

/** True for an axis whose labels are multiples of a step, as those of a linear axis. */
export const isNarrow = (low: number, high: number): boolean => Math.log10(high / low) < NARROW;

/** Labelled values of an axis whose labels need the distance `nearest`, a share of the axis. */
export function logLabels(low: number, high: number, nearest: number): number[] {
    const decades = Math.log10(high / low);
    const fits = ({ values, rooms }: LabelSet) => values.length > 1 && values.every((value, k) => k === 0 || Math.log10(value / values[k - 1]) >= rooms * nearest * decades);
    return sets(low, high).find(fits)?.values ?? ends(lines(low, high));
}

/** Lines of the grid. */
export function lines(low: number, high: number): number[] {
    const decades = Math.log10(high / low);
    if (isNarrow(low, high)) return multiples(low, high, finest(low, high));
    return ofDecades(low, high, decades > WIDE ? [1] : [1, 2, 3, 4, 5, 6, 7, 8, 9]);
}

function sets(low: number, high: number): LabelSet[] {
    if (isNarrow(low, high)) {
        const steps: number[] = [];
        for (let step = finest(low, high); step < high; step = stepOfAtLeast(1.5 * step)) steps.push(step);
        return steps.map((step) => ({ values: multiples(low, high, step), rooms: 1 }));
    }
    const powers = ofDecades(low, high, [1]);
    const every = (count: number) => powers.filter((power) => Math.round(Math.log10(power)) % count === 0);
    const thinned = powers.map((_, k) => ({ values: every(k + 1), rooms: 1 }));
    return [{ values: ofDecades(low, high, [1, 2, 5]), rooms: powers.length < 3 ? 1 : 2 }, ...thinned];
}

const finest = (low: number, high: number) => stepOfAtLeast((high - low) / MAX_STEPS);

/** The smallest step of 1, 2 or 5 times a power of ten that is not below a value. */
function stepOfAtLeast(value: number): number {
    const power = Math.floor(Math.log10(value));
    return Number(`${[1, 2, 5].find((factor) => factor * 10 ** power >= value * (1 - ROUNDING)) ?? 10}e${power}`);
}

function multiples(low: number, high: number, step: number): number[] {
    const first = Math.ceil(low / step - ROUNDING);
    const count = Math.floor(high / step + ROUNDING) - first + 1;
    return Array.from({ length: count }, (_, k) => Number(((first + k) * step).toPrecision(12)));
}

/** Values of the given mantissas between both ends. */
function ofDecades(low: number, high: number, mantissas: number[]): number[] {
    const [first, last] = [Math.floor(Math.log10(low)), Math.ceil(Math.log10(high))];
    const all = Array.from({ length: last - first + 1 }, (_, k) => mantissas.map((mantissa) => Number(`${mantissa}e${first + k}`))).flat();
    return all.filter((value) => value >= low * (1 - ROUNDING) && value <= high * (1 + ROUNDING));
}

const ends = (values: number[]) => (values.length > 2 ? [values[0], values[values.length - 1]] : values);
