// Plane of starts of the basins: the ends of both sides, as in `jounce basins --grid`, and the number of starts.

import type { Frame } from "./frame";
import { withUnit } from "./rows";
import { digits, quantity } from "./units";

/** Unit of a bare number of a side, its size in SI, and the name of the side in a frame. */
const SIDES = { displacement: ["mm", 1e-3, "displacement_m", "m"], velocity: ["m/s", 1, "velocity_m_s", "m/s"] } as const;

export type Side = keyof typeof SIDES;

const NAMES = Object.keys(SIDES) as Side[];
const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;
const fields = (side: Side) => ["from", "to"].map((end) => find<HTMLInputElement>(`basins-${side}-${end}`));

export class Plane {
    private readonly count = find<HTMLSelectElement>("basins-starts");

    /** `changed` is called when another plane is chosen. */
    constructor(changed: () => void) {
        for (const field of [this.count, ...NAMES.flatMap(fields)]) field.addEventListener("change", changed);
    }

    /** The chosen plane as text. */
    get text(): string {
        return JSON.stringify(this.options);
    }

    /** The plane as the server takes it; sides without ends have the size of the motion. */
    get options(): { starts: number; grid: string[] } {
        const grid = NAMES.filter((side) => this.ends(side) !== "").map((side) => `${side}=${fields(side).map(({ value }) => withUnit(value, SIDES[side][0])).join(":")}`);
        return { starts: Number(this.count.value), grid };
    }

    /** A side with one end only. */
    get fault(): string {
        const half = NAMES.find((side) => this.ends(side) !== "" && fields(side).some(({ value }) => value.trim() === ""));
        return half ? `give both ends of the ${half}, or none for the size of the motion` : "";
    }

    /** The ends of a side, FROM:TO; "" for the size of the motion. */
    ends(side: Side): string {
        const texts = fields(side).map(({ value }) => value.trim());
        return texts.every((text) => text === "") ? "" : texts.join(":");
    }

    /** Chooses the ends of a side; returns a message where they are none. */
    setEnds(side: Side, text: string): string | undefined {
        const ends = text === "" ? ["", ""] : text.split(":");
        if (ends.length !== 2) return `the link has ${side} = "${text}"; it is FROM:TO`;
        fields(side).forEach((field, k) => (field.value = ends[k]));
        this.count.dispatchEvent(new Event("change"));
        return undefined;
    }

    /** Number of starts by default: that of the page as it is served. */
    private get usual(): string {
        return [...this.count.options].find((option) => option.defaultSelected)!.value;
    }

    /** The number of starts; "" for the default. */
    get starts(): string {
        return this.count.value === this.usual ? "" : this.count.value;
    }

    /** Chooses the number of starts; returns a message where it is not offered. */
    setStarts(text: string): string | undefined {
        const value = text || this.usual;
        if (![...this.count.options].some((option) => option.value === value)) return `the link has ${text} starts, which the page does not offer`;
        this.count.value = value;
        this.count.dispatchEvent(new Event("change"));
        return undefined;
    }

    /** Shows the ends of the plane of a result as those of empty fields, and returns it in words. */
    taken(frame: Frame): string {
        const sides = NAMES.map((side) => {
            const [, factor, name, unit] = SIDES[side];
            const values = [...new Set(frame.array(name))].sort((a, b) => a - b);
            const ends = [values[0], values[values.length - 1]];
            fields(side).forEach((field, k) => (field.placeholder = digits(ends[k] / factor, 3)));
            return { count: values.length, words: `${side} ${ends.map((end) => quantity(end, unit, 3)).join(" to ")}` };
        });
        return `${sides.map(({ count }) => count).join(" x ")} starts, ${sides.map(({ words }) => words).join(", ")}`;
    }
}
