// A sentence about the limits of the harvester at its operating point, for all starts: nothing beyond what their settled motions show.

import type { Head } from "./frame";
import type { Attractor, Limit, Peaks } from "./operating";
import { digits, quantity } from "./units";

interface Share {
    fraction: number;
    low: number;
    high: number;
}

const percent = (value: number, count = 2) => digits(100 * value, count);
/** A share of the starts with its 95 % interval. */
const shareWords = ({ fraction, low, high }: Share) => `${percent(fraction, 3)} % of the starts, 95 %: ${percent(low)} to ${percent(high)}`;
const valueWords = (name: string, value: number) => (name === "strain" ? `${digits(1e6 * Math.abs(value), 3)} ppm` : quantity(value, "V", 3));

/** Each limit with its value nearest to it on any of the attractors. */
function worst(peaks: Peaks[]): Limit[] {
    const found = new Map<string, Limit>();
    for (const own of peaks.flatMap(({ limits }) => limits)) {
        const name = `${own.patch} ${own.quantity}`;
        const known = found.get(name);
        if (!known || own.excess > known.excess) found.set(name, own);
    }
    return [...found.values()];
}

/** Name of a patch in a sentence. */
const patchWords = ({ patch }: Limit) => (patch === "patch" ? "the patch" : `patch ${patch}`);

/** The attractors beyond a limit, each with the share of the starts that reach it. */
function beyondWords(head: Head): string {
    const attractors = head.attractors as Attractor[];
    const parts = attractors.flatMap((own, k) => {
        const over = (head.peaks as Peaks[])[k].limits.filter(({ excess }) => excess > 0).map((limit) =>
            `the ${limit.quantity} of ${patchWords(limit)} is ${valueWords(limit.quantity, limit.reached)}, ${percent(limit.excess / Math.abs(limit.bound), 3)} % beyond its limit of ${valueWords(limit.quantity, limit.bound)}`);
        const share = { fraction: own.fraction, low: own.fraction_low, high: own.fraction_high };
        return over.length > 0 ? [`at ${quantity(own.mean_power_w, "W")} (${shareWords(share)}) ${over.join(" and ")}`] : [];
    });
    const within = Math.round(head.limit_shares.within.fraction * head.finished);
    return `Not within the limits after every start: ${parts.join("; ")}${within > 0 ? `; after ${within} of ${head.finished} starts the limits are kept` : ""}.`;
}

/** Largest values over some attractors, with their limits. */
function peakWords(head: Head, peaks: Peaks[]): string[] {
    const limits = worst(peaks);
    const of = (own: Limit) => (new Set(limits.map(({ patch }) => patch)).size > 1 ? ` of ${patchWords(own)}` : "");
    const strain = Math.max(...peaks.map((own) => own.strain_peak ?? Number.NaN));
    const impact = Math.max(...peaks.map((own) => own.max_impact_velocity_m_s!));
    const stop = head.stops === 1 ? "the stop is" : "a stop is";
    return [
        ...limits.map((own) => own.quantity === "strain"
            ? `the strain${of(own)} stays below ${valueWords("strain", own.limits[1])} (at most ${valueWords("strain", own.reached)})`
            : `the voltage${of(own)} stays within ${own.limits.map((end) => quantity(end, "V", 3)).join(" to ")} (nearest ${valueWords("voltage", own.reached)})`),
        ...(Number.isFinite(strain) && !limits.some((own) => own.quantity === "strain") ? [`the strain is at most ${valueWords("strain", strain)} (no limit given; set the strain limit of a patch)`] : []),
        ...(head.stops === 0 ? [] : impact > 0 ? [`${stop} struck at most at ${quantity(impact, "m/s", 3)}`] : [`${head.stops === 1 ? "the stop is not" : "no stop is"} struck`]),
    ];
}

/** What the settled motions of all starts say about the limits; "" where nothing is known. */
export function safetyWords(head: Head): string {
    const { limit_shares: shares, finished } = head;
    if (shares.beyond.fraction > 0) {
        const more = shares.unknown.fraction > 0 ? ` Other peaks are not known (${shareWords(shares.unknown)}).` : "";
        return beyondWords(head) + more;
    }
    const known = (head.peaks as Peaks[]).filter((own) => own.max_impact_velocity_m_s !== null);
    if (known.length === 0) return "Whether the motion keeps its limits is not known: it has no period.";
    const parts = peakWords(head, known);
    if (parts.length === 0) return "";
    const within = Math.round(shares.within.fraction * finished);
    const from = within === finished ? `all ${finished} starts` : `${within} of ${finished} starts`;
    const rest = within === finished ? `At most ${percent(shares.within.high - shares.within.low)} % of such starts (95 %) lead elsewhere.` : `The peaks after the other ${finished - within} are not known (${shareWords(shares.unknown)}).`;
    return `Settled motion after ${from}: ${parts.length > 1 ? `${parts.slice(0, -1).join(", ")}, and ${parts[parts.length - 1]}` : parts[0]}. ${rest}`;
}
