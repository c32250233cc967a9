// Formatting of numbers.

import { isNarrow } from "./ticks";

const PREFIXES: [number, string][] = [
    [1e12, "T"], [1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"], [1e-12, "p"], [1e-15, "f"], [1e-18, "a"],
];
const NO_PREFIX: [number, string] = [1, ""];

/** Size below which a value is roundoff, such as the power behind diodes that do not conduct: a thousandth of the smallest prefix. */
const ROUNDOFF = 1e-21;

/** A value without roundoff. */
export const withoutRoundoff = (value: number): number => (Math.abs(value) < ROUNDOFF ? 0 : value);

/** Size and name of the prefix for a value. */
export function prefix(value: number): [number, string] {
    const size = Math.abs(value);
    if (!Number.isFinite(size) || size === 0) return NO_PREFIX;
    return PREFIXES.find(([step]) => size >= 0.9999999 * step) ?? PREFIXES[PREFIXES.length - 1];
}

/** Units that take a prefix, as in crates/jounce-plot/src/axis/unit.rs. */
const TAKES_PREFIX = ["W", "V", "A", "N", "m", "s", "Hz", "ohm", "F", "J", "Pa", "C", "H", "S"];

const takesPrefix = (unit: string) => TAKES_PREFIX.includes(unit);

const RAISED: Record<string, string> = { "-": "⁻", ".": "·", "0": "⁰", "1": "¹", "2": "²", "3": "³", "4": "⁴", "5": "⁵", "6": "⁶", "7": "⁷", "8": "⁸", "9": "⁹" };

/** A text with its powers as they are set in print: "1000 N/m¹·⁵". */
export function raised(text: string): string {
    return text.replace(/\^(-?[\d.]+)/g, (_, power: string) => [...power].map((own) => RAISED[own]).join(""));
}

/** A message of the program with its units as they are set in print: "3 us, 5 kohm" is "3 µs, 5 kΩ". */
export function printed(message: string): string {
    return message.replace(/(?<=\d )u(?=[A-Za-z])/g, "µ").replace(/(?<=\d [kMG]?)ohm\b/g, "Ω");
}

/** A unit as it is set in print: "MΩ", "µF", "N/m¹·⁵". */
export function sign(unit: string): string {
    return raised(unit.replace(/^u(?=[A-Za-z])/, "µ").replace("ohm", "Ω"));
}

/** Numbers from here on have an exponent: "1e7" fits a field, "10000000" does not. */
const LONG = 1e6;

/** A number with at most `count` significant digits, without trailing zeros. */
export function digits(value: number, count = 4): string {
    if (!Number.isFinite(value)) return "–";
    const text = value.toPrecision(count);
    if (Math.abs(value) >= LONG) return Number(text).toExponential().replace("+", "");
    return text.includes("e") ? String(Number(text)) : text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}

/** A value with its unit, `"1.23 mW"`. */
export function quantity(computed: number, unit: string, count = 4): string {
    const value = withoutRoundoff(computed);
    if (!takesPrefix(unit) || (unit === "Hz" && Math.abs(value) < 1)) return `${digits(value, count)} ${sign(unit)}`.trim();
    const [step, name] = prefix(value);
    return `${digits(value / step, count)} ${name}${sign(unit)}`;
}

/** Most digits of a value with an error. */
const MOST_DIGITS = 9;

/** A value with its error and unit, "12.590016 ± 2.5e-10 Hz", with the digits that the error supports. */
export function quantityWithError(value: number, error: number | null, unit: string): string {
    if (!error || value === 0) return quantity(value, unit, 5);
    const [step, name] = takesPrefix(unit) ? prefix(value) : NO_PREFIX;
    const supported = Math.floor(Math.log10(Math.abs(value))) - Math.floor(Math.log10(error)) + 1;
    const text = (value / step).toPrecision(Math.min(Math.max(supported, 1), MOST_DIGITS));
    return `${text} ± ${digits(error / step, 2)} ${name}${sign(unit)}`;
}

/** True for units that take a prefix on an axis: also a quotient, whose first unit takes it ("mm/s"). */
const takesAxisPrefix = (unit: string) => takesPrefix(unit.split("/")[0]);

/** Divisor and unit of the numbers of a linear axis: those of its largest value. A round thousand at its end does not change the unit: 0 to 1000 Hz. */
export function axisUnit(low: number, high: number, unit: string): [number, string] {
    if (!takesAxisPrefix(unit)) return [1, sign(unit)];
    const most = Math.max(Math.abs(low), Math.abs(high));
    const [size] = prefix(most);
    const [step, name] = prefix(size > 1 && most < 1.1 * size ? size / 1000 : most);
    return [step, name + sign(unit)];
}

/** Span from which on a prefix does not help, decades: 10⁻⁵ W is easier to read than 10000 nW. */
const MANY_DECADES = 4.5;

/**
 * Divisor and unit of a logarithmic axis. With equal steps they are those of a linear one; else the first that makes the labels plain: no
 * prefix, the prefix of the smallest value, the next larger prefix. Where none does, there is no prefix.
 */
export function logAxisUnit(low: number, high: number, unit: string): [number, string] {
    if (isNarrow(low, high)) return axisUnit(low, high, unit);
    const takes = takesAxisPrefix(unit) && Math.log10(high / low) < MANY_DECADES;
    const smallest = PREFIXES.indexOf(prefix(low));
    const offered = takes ? [NO_PREFIX, PREFIXES[smallest], PREFIXES[Math.max(smallest - 1, 0)]] : [];
    const [step, name] = offered.find(([size]) => isPlain(low / size, high / size)) ?? NO_PREFIX;
    return [step, name + sign(unit)];
}

/** True where the powers of ten of a logarithmic axis are readable as plain decimals: 0.001 to 10000. */
export const isPlain = (low: number, high: number): boolean => Math.ceil(Math.log10(low)) >= -3 && Math.floor(Math.log10(high)) <= 4;

/** A number of one digit as a power of ten: "10⁻⁵", "2×10⁻⁵". */
export function scientific(value: number): string {
    const [mantissa, power] = value.toExponential(6).split("e").map(Number);
    return `${mantissa === 1 ? "" : `${mantissa}×`}10${raised(`^${power}`)}`;
}
