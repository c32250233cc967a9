// Response over a key: branches, bifurcations, swept points, pins, and the selected point.

import { kindOf, rank } from "./bifurcations";
import { type Bifurcation, type Branch, type ResponseResult, type Place, type Quantity, described, identify, isGap, isStable, level, pointAt, valueAt } from "./branches";
import { Chart } from "./chart";
import type { Design } from "./design";
import { type DraftError, draftError, errorWords } from "./draft-error";
import { limitWords } from "./limit-ranges";
import { LineHandle } from "./line";
import { type MeasuredPoints, measuredCurves } from "./measured";
import type { Curve, Mark, Rule } from "./paint";
import { Pointing } from "./pointing";
import { type Readout, draftWords, peakWords, sentence, showOptions } from "./readout";
import type { Head } from "./frame";
import type { OrbitSource } from "./shown-orbit";
import { stableWords } from "./stability";
import { colour, nth } from "./theme";
import { digits, quantity } from "./units";

/** Opacity of a draft. */
const DRAFT = 0.4;
/** Opacity of the start of a design search, and of a band; relative opacity of a band that some drawn designs do not have. */
const START = 0.35;
const BAND = 0.3;
const PARTIAL = 0.45;
/** Longest period, in drive cycles, that is always shown. */
const SHORT_PERIOD = 2;
/** Longest period that is searched for on request. */
const LONG_PERIOD = 8;

export interface Swept {
    /** Signature of its design, and the key of the sweep. */
    design: string;
    over: string;
    x: number;
    up: boolean;
    values: Partial<Record<Quantity, number>>;
}

/** Quantiles of the power under tolerances, and the share of the drawn designs that have the orbit. */
export interface PowerBand {
    over: string;
    x: Float64Array;
    low: Float64Array;
    high: Float64Array;
    share: Float64Array;
}

export interface Pinned {
    result: ResponseResult;
    words: string;
    colour: number;
}

export class Response {
    readonly chart: Chart;
    result: ResponseResult | undefined;
    chosen: Place | undefined;
    /** Value of the key of the selected orbit, where it differs from that of the point. */
    chosenParameter: number | undefined;
    swept: Swept[] = [];
    pins: Pinned[] = [];
    measured: MeasuredPoints[] = [];
    /** Response at the start of a design search. */
    start: ResponseResult | undefined;
    band: PowerBand | undefined;
    quantity: Quantity = "power";
    log = true;
    range: [number, number] = [0, 1];
    grazings = false;
    longPeriods = false;
    /** Value of the key in the present design, and the period of the attractor there that most starts reach. */
    at: number | undefined;
    attractorPeriod: number | undefined;
    /** Smallest strain limit of the patches, ppm. */
    strainLimit: number | undefined;
    /** True while the selected point is the operating point. */
    following = true;
    /** Axis title of a key. */
    words: (key: string) => string = (key) => key;
    private widths: Head | undefined;
    /** Difference of the last draft from its result. */
    private draftError: DraftError | undefined;
    private hovered: Place | undefined;
    private readonly cursor = document.getElementById("response-cursor")!;
    private readonly incomplete = document.getElementById("incomplete")!;
    onChoose: (place: Place, parameter?: number) => void = () => {};
    /** Called when the selected point may have changed, with its values in words. */
    onPoint: (words: string) => void = () => {};

    /** Called when the line of the operating point is dragged. */
    onMove: (value: number, moving: boolean) => void = () => {};

    constructor(host: HTMLElement, private readonly readout: Readout, private readonly design: Design) {
        this.chart = new Chart(host);
        const line = new LineHandle(this.chart, () => this.at, (value, moving) => this.onMove(Math.min(Math.max(value, this.range[0]), this.range[1]), moving));
        // Its value is the selected point, which the arrow keys move.
        host.tabIndex = 0;
        host.setAttribute("role", "slider");
        new Pointing(this, line, this.cursor);
    }

    /** Shows a new response, without a ring until its place is known. One over another key shows the operating point. */
    take(result: ResponseResult): void {
        const { result: last } = this;
        const same = last?.over === result.over;
        if (same) identify(last, result, this.span);
        else this.following = true;
        if (last?.id === result.id && last.draft && last.draft.origin !== "first" && !result.draft) this.draftError = draftError(last, result, this.span);
        this.hovered = undefined;
        this.result = result;
        this.chosen = this.chosenParameter = undefined;
        this.widths = undefined;
    }

    /** Draws the ring at a point, or at a value of the key next to it. */
    mark(place: Place | undefined, parameter?: number): void {
        this.chosen = place && { branch: place.branch, point: place.point };
        this.chosenParameter = parameter;
        this.draw();
    }

    /** True where the present value of the key is outside the range that was searched. */
    get isOutside(): boolean {
        return this.at !== undefined && !(this.at >= this.range[0] && this.at <= this.range[1]);
    }

    /** True where the response belongs to an earlier design. */
    get isOld(): boolean {
        return this.result !== undefined && this.design.isOld(this.result);
    }

    private get span(): number {
        return this.range[1] - this.range[0];
    }

    takeWidths(head: Head): void {
        this.widths = head;
        this.tell();
    }

    /** Selects a point, with the orbit at a value of the key next to it. */
    choose(place: Place, parameter?: number): void {
        this.following = false;
        this.mark(place, parameter);
        this.onChoose(place, parameter);
    }

    /** The orbit of a point, or at a value of the key next to it. */
    orbitSource({ branch, point }: Place, parameter?: number): OrbitSource | undefined {
        const { result } = this;
        if (!result) return undefined;
        const { id, design, over, unit, branches } = result;
        const at = quantity(parameter ?? branches[branch].x[point], unit, 5);
        return { place: { response: id, branch, point, parameter }, at, design, over };
    }

    draw(): void {
        const { result } = this;
        if (!result) return;
        const { words, unit } = described(this.quantity, result);
        const alpha = result.draft || this.isOld ? DRAFT : 1;
        const curves: Curve[] = [];
        if (this.quantity === "power") curves.push({ x: result.linear.x, y: result.linear.power, colour: colour("grey"), width: 1.4, words: "without contact" });
        curves.push(...this.bandArea(result, alpha));
        if (this.start?.over === result.over) curves.push(...this.lines(this.start, () => colour("ink"), START));
        const pins = this.pins.filter((pin) => pin.result.over === result.over);
        pins.forEach((pin) => curves.push(...this.lines(pin.result, () => nth(pin.colour), 0.55)));
        curves.push(...this.lines(result, (branch) => nth(branch.identity), alpha));
        curves.push(...this.sweepPoints(result), ...measuredCurves(this.measured, this.quantity, result.unit));
        const rules: Rule[] = this.quantity === "floquet" ? [{ at: 1, along: "y" as const, words: "stable below" }] : [];
        if (this.quantity === "strain" && this.strainLimit !== undefined) rules.push({ at: this.strainLimit, along: "y", words: `limit ${digits(this.strainLimit)} ppm` });
        if (this.at !== undefined) rules.push({ at: this.at, along: "x", words: quantity(this.at, result.unit, 5), strong: true });
        this.chart.waiting = this.isComputing(result) ? "computing strain" : "";
        this.chart.show({ words: this.words(result.over), unit: result.unit, ends: this.range }, { words, unit, log: this.isLog(result), holds: this.heldLimit(result) }, curves, this.marks(result), rules);
        this.tell();
    }

    /** True where the strain is shown and the server computes it. */
    private isComputing({ branches }: ResponseResult): boolean {
        return this.quantity === "strain" && branches.some(({ values }) => values.strain.length === 0);
    }

    /** True where the vertical axis is logarithmic: not where all values are 0. */
    private isLog(result: ResponseResult): boolean {
        return this.log && (this.shownValues(result).some((value) => value > 0) || !this.shownValues(result).some((value) => value === 0));
    }

    /** The strain limit, where the logarithmic axis shows it next to the strain. */
    private heldLimit(result: ResponseResult): number | undefined {
        return this.quantity === "strain" && this.isLog(result) && !this.isComputing(result) ? this.strainLimit : undefined;
    }

    /** Values of the quantity on the branches that are shown. */
    private shownValues({ branches }: ResponseResult): number[] {
        return branches.filter((branch) => this.shows(branch)).flatMap((branch) => [...branch.values[this.quantity]]);
    }

    /** What a logarithmic axis cannot show. */
    private zeroWords(result: ResponseResult): string[] {
        const values = this.log ? this.shownValues(result) : [];
        const zeros = values.filter((value) => value === 0).length;
        if (zeros === 0) return [];
        if (zeros === values.length) return ["All values are 0, so the axis is linear."];
        return [`On the logarithmic axis ${zeros} of ${values.length} points are missing, because their value is 0.`];
    }

    /** The band, paler where only some of the drawn designs have the orbit. */
    private bandArea(result: ResponseResult, alpha: number): Curve[] {
        const { band } = this;
        if (!band || band.over !== result.over || this.quantity !== "power") return [];
        const fill = (k: number) => (band.share[k] >= 1 ? 1 : band.share[k] >= 0.5 ? PARTIAL : 0);
        return [{ x: band.x, y: band.low, upper: band.high, fill, colour: colour("green"), alpha: alpha * BAND }];
    }

    private sweepPoints({ over }: ResponseResult): Curve[] {
        const old = this.swept.some((point) => this.design.isOld(point));
        return [true, false].map((up) => {
            const points = this.swept.filter((point) => point.over === over && point.up === up && point.values[this.quantity] !== undefined);
            return { x: points.map((p) => p.x), y: points.map((p) => p.values[this.quantity]!), colour: colour(up ? "ink" : "orange"), shape: up ? ("up" as const) : ("down" as const), size: 3.5, alpha: old ? 0.25 : 1 };
        });
    }

    /** Bifurcations, none on a draft or of an earlier design, and the rings of the hovered and of the selected point. */
    private marks(result: ResponseResult): Mark[] {
        const shown = [...this.listed(result)].sort((a, b) => rank(a.kind) - rank(b.kind));
        const marks: Mark[] = shown.map((found) => ({ x: found.x, y: valueAt(found, this.quantity, result, this.span), colour: colour("ink"), shape: kindOf(found.kind).shape, size: 2.8, yields: true }));
        for (const [place, size] of [[this.hovered, 5], [this.chosen, 7]] as const) {
            const branch = place && result.branches[place.branch];
            if (!branch) continue;
            const own = place === this.chosen ? this.chosenBifurcation : undefined;
            const at = place === this.chosen ? this.chosenAt : undefined;
            const [x, y] = own ? [own.x, valueAt(own, this.quantity, result, this.span)] : at === undefined ? [branch.x[place.point], branch.values[this.quantity][place.point]] : pointAt(branch, place.point, at, this.quantity);
            marks.push({ x, y, colour: colour("vermilion"), shape: "ring", size });
        }
        return marks;
    }

    /** Bifurcations that are shown: grazings, and those of long periods, only on request. */
    listed(result: ResponseResult): Bifurcation[] {
        if (result.draft || this.isOld) return [];
        return result.bifurcations.filter((found) => (this.grazings || found.kind !== "grazing") && this.shows(result.branches[found.branch]));
    }

    shows(branch: Branch): boolean {
        return branch.period <= (this.longPeriods ? Infinity : SHORT_PERIOD) || branch.period === this.attractorPeriod;
    }

    /** Longest period to search for: short, unless longer ones are shown or the attractor of the operating point has one. */
    get longestPeriod(): number {
        return Math.max(this.longPeriods ? LONG_PERIOD : SHORT_PERIOD, this.attractorPeriod ?? 0);
    }

    private lines(result: ResponseResult, own: (branch: Branch) => string, alpha: number): Curve[] {
        return result.branches.filter((branch) => this.shows(branch)).map((branch) => ({
            x: branch.x,
            y: branch.values[this.quantity],
            colour: own(branch),
            width: 2,
            alpha,
            gap: isGap(result, branch),
            dashed: (from) => !(isStable(branch, from) && isStable(branch, from + 1)),
        }));
    }

    /** Text below the chart. */
    private tell(): void {
        const { result } = this;
        if (!result) return;
        const hidden = result.branches.filter((branch) => !this.shows(branch)).length;
        const text = [
            ...(this.isOld ? ["Draft: of an earlier design; curves may be wrong or missing until the search ends."] : result.draft ? [draftWords(result.draft)] : [stableWords(result, this.range), ...peakWords(this.widths, result.unit)]),
            ...(this.swept.some((point) => point.over === result.over && this.design.isOld(point)) ? ["The swept points are of an earlier design."] : []),
            ...this.zeroWords(result),
            ...(this.isComputing(result) ? ["Computing the strain."] : []),
            ...(this.quantity === "strain" && this.strainLimit !== undefined ? [limitWords(result, this.range, this.strainLimit)] : []),
            ...(this.start ? ["Pale: the start of the design search."] : []),
            ...(this.band ? ["Shaded: 5 % to 95 % of the designs drawn from the tolerances."] : []),
            ...(hidden > 0 ? [`${hidden} ${hidden === 1 ? "branch" : "branches"} of a period above ${SHORT_PERIOD} not shown.`] : []),
            ...(result.branches.length === 0 && !result.draft && !this.isOld ? ["No periodic orbit was found in this range."] : []),
        ].filter(Boolean).join(" ");
        this.readout.show(text, result.note, this.draftError ? errorWords(this.draftError) : "", this.listed(result), result.unit, (found) => this.chooseNear(found));
        showOptions(this.incomplete, this.isOld || result.draft ? "" : sentence(result.budgetNote));
        this.incomplete.hidden = this.incomplete.textContent === "";
        const count = result.branches.length;
        this.chart.host.setAttribute("aria-label", `${described(this.quantity, result).words} over ${result.over}: ${count} ${count === 1 ? "branch" : "branches"}. Arrow keys move along the branch. ${text}`);
        this.tellPoint(result);
    }

    /** The selected point, for screen readers. */
    private tellPoint({ branches }: ResponseResult): void {
        const found = this.chosenBifurcation;
        const x = found?.x ?? (this.chosen && (this.chosenAt ?? branches[this.chosen.branch]?.x[this.chosen.point]));
        const words = found ? `${found.kind}, ${quantity(found.x, this.result!.unit, 5)}, ${quantity(found.power, "W")}` : this.pointWords(this.chosen);
        const value = { now: x ?? this.range[0], min: this.range[0], max: this.range[1], text: words || "no point selected" };
        for (const [name, own] of Object.entries(value)) this.chart.host.setAttribute(`aria-value${name}`, String(own));
        this.onPoint(words);
    }

    /** Value of the key at the point that the user has selected; undefined at the operating point. */
    get selectedValue(): number | undefined {
        const { chosen, result } = this;
        return this.following || !chosen ? undefined : this.chosenParameter ?? result?.branches[chosen.branch]?.x[chosen.point];
    }

    /** Value of the key of the selected orbit, where it is next to the point. */
    private get chosenAt(): number | undefined {
        return this.following ? this.at : this.chosenParameter;
    }

    /** The bifurcation whose orbit is selected. */
    get chosenBifurcation(): Bifurcation | undefined {
        return this.result?.bifurcations.find((own) => own.branch === this.chosen?.branch && own.x === this.chosenParameter);
    }

    private chooseNear(found: Bifurcation): void {
        const branch = this.result!.branches[found.branch];
        const away = Array.from(branch.x, (x, k) => Math.hypot((x - found.x) / this.span, 0.2 * (level(branch.values.power[k]) - level(found.power))));
        const point = away.indexOf(Math.min(...away));
        this.choose({ branch: found.branch, point }, found.x);
    }

    /** Shows the values of the point under the pointer. */
    hover(place: Place | undefined): void {
        if (place?.branch === this.hovered?.branch && place?.point === this.hovered?.point) return;
        this.hovered = place;
        this.cursor.textContent = this.pointWords(this.hovered);
        this.draw();
    }

    /** Branches that are drawn. */
    drawn(): { branch: number; x: ArrayLike<number>; y: ArrayLike<number>; gap: (from: number) => boolean }[] {
        const { result } = this;
        if (!result) return [];
        return result.branches.flatMap((own, branch) => (this.shows(own) ? [{ branch, x: own.x, y: own.values[this.quantity], gap: isGap(result, own) }] : []));
    }

    /** Values of a point in words. */
    private pointWords(place: Place | undefined): string {
        const branch = place && this.result!.branches[place.branch];
        if (!branch) return "";
        const { point } = place;
        const { words, unit } = described(this.quantity, this.result!);
        const more = this.quantity === "power" ? [] : [`${words[0].toLowerCase()}${words.slice(1)} ${quantity(branch.values[this.quantity][point], unit)}`];
        const values = [quantity(branch.x[point], this.result!.unit, 5), quantity(branch.values.power[point], "W"), ...more];
        return [...values, `period ${branch.period}`, isStable(branch, point) ? "stable" : "unstable", `${digits(branch.contacts[point])} ${branch.contacts[point] === 1 ? "contact" : "contacts"}`].join(", ");
    }
}
