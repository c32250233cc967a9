// Legend of the response: the kinds of curves and marks that it shows.

import { kindOf } from "./bifurcations";
import { isStable } from "./branches";
import type { LegendEntry } from "./legend";
import type { Response } from "./response";
import { colour, nth } from "./theme";

/** Kinds of curves and marks on the chart of a response. */
export function responseLegend(response: Response): LegendEntry[] {
    const { result, quantity, pins, start, band, measured } = response;
    if (!result) return [];
    const branches = result.branches.filter((branch) => response.shows(branch));
    const has = (stable: boolean) => branches.some((branch) => Array.from(branch.x.keys()).some((k) => isStable(branch, k) === stable));
    const ink = colour("ink");
    const kinds = [...new Set(response.listed(result).map(({ kind }) => kind))];
    const swept = response.swept.filter((point) => point.over === result.over && point.values[quantity] !== undefined);
    const entries: (LegendEntry | false | undefined)[] = [
        has(true) && { words: "stable", colour: ink },
        has(false) && { words: "unstable", colour: ink, dashed: true },
        quantity === "power" && { words: "without contact", colour: colour("grey") },
        ...kinds.map((kind) => ({ words: kindOf(kind).words, colour: ink, shape: kindOf(kind).shape })),
        ...pins.filter((pin) => pin.result.over === result.over).map((pin) => ({ words: `pinned: ${pin.words}`, colour: nth(pin.colour), alpha: 0.55 })),
        start?.over === result.over && { words: "start of the design search", colour: ink, alpha: 0.35 },
        band && band.over === result.over && quantity === "power" && { words: "5 % to 95 % under the tolerances", colour: colour("green"), alpha: 0.3, area: true },
        swept.some(({ up }) => up) && { words: "sweep up", colour: ink, shape: "up" },
        swept.some(({ up }) => !up) && { words: "sweep down", colour: colour("orange"), shape: "down" },
        measured.length > 0 && { words: "measured", colour: ink, shape: "plus" },
        { words: "orbit that is shown", colour: colour("vermilion"), shape: "ring" },
    ];
    return entries.filter((entry): entry is LegendEntry => Boolean(entry));
}
