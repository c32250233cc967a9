// Kinds of bifurcations: their words and marks. Where marks would overlap, that of the first kind is drawn.

import type { Mark } from "./paint";

interface Kind {
    words: string;
    shape: Mark["shape"];
    /** True where a multiplier has modulus one. */
    isCritical: boolean;
}

const KINDS: Record<string, Kind> = {
    "fold": { words: "fold", shape: "square", isCritical: true },
    "period-doubling": { words: "period doubling", shape: "triangle", isCritical: true },
    "neimark-sacker": { words: "Neimark-Sacker bifurcation", shape: "diamond", isCritical: true },
    "branch-point": { words: "branch point", shape: "cross", isCritical: true },
    "grazing": { words: "grazing", shape: "circle", isCritical: false },
    "sticking": { words: "start of sticking", shape: "ring", isCritical: false },
};

/** The kind of a bifurcation; that of a level is its name. */
export const kindOf = (name: string): Kind => KINDS[name] ?? { words: name, shape: "cross", isCritical: false };

/** Place of a kind in their order; -1 for a level. */
export const rank = (name: string): number => Object.keys(KINDS).indexOf(name);
