// Formatting of numbers.

const PREFIXES: [number, string][] = [
    [1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"], [1e-12, "p"],
];

/** Size and name of the prefix for a value. */
export function prefix(value: number): [number, string] {
    const size = Math.abs(value);
    if (!Number.isFinite(size) || size === 0) return [1, ""];
    return PREFIXES.find(([step]) => size >= 0.9999999 * step) ?? PREFIXES[PREFIXES.length - 1];
}

/** Units that take a prefix: a single name without powers or quotients. */
const takesPrefix = (unit: string) => /^[A-Za-z]+$/.test(unit) && unit !== "kg" && unit !== "rad";

/** A number with at most `digits` significant digits, without trailing zeros. */
export function digits(value: number, count = 4): string {
    if (!Number.isFinite(value)) return "–";
    const text = value.toPrecision(count);
    return text.includes("e") ? String(Number(text)) : text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}

/** A value with its unit, `"1.23 mW"`. */
export function quantity(value: number, unit: string, count = 4): string {
    if (!takesPrefix(unit)) return `${digits(value, count)} ${unit}`.trim();
    const [step, name] = prefix(value);
    return `${digits(value / step, count)} ${name}${unit}`;
}

/** Divisor and unit of an axis up to a value. */
export function axisUnit(most: number, unit: string): [number, string] {
    if (!takesPrefix(unit)) return [1, unit];
    const [step, name] = prefix(most);
    return [step, name + unit];
}
