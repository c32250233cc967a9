// Response over a key: branches, bifurcations, swept points, pins; a click or the arrow keys select a point.

import { type ResponseResult, type Place, QUANTITIES, type Quantity, best, isStable, nearest } from "./branches";
import { Chart } from "./chart";
import type { Curve, Mark } from "./paint";
import type { Head } from "./frame";
import { colour, nth } from "./theme";
import { digits, quantity } from "./units";

const SHAPES: Record<string, Mark["shape"]> = {
    fold: "circle", "period-doubling": "diamond", "neimark-sacker": "triangle", "branch-point": "cross", grazing: "square",
};
/** Largest distance of a click from a point, CSS pixels. */
const REACH = 40;

export interface Swept {
    x: number;
    up: boolean;
    values: Partial<Record<Quantity, number>>;
}

export interface Pinned {
    result: ResponseResult;
    words: string;
}

export class Response {
    readonly chart: Chart;
    result: ResponseResult | undefined;
    chosen: Place | undefined;
    swept: Swept[] = [];
    pins: Pinned[] = [];
    quantity: Quantity = "power";
    log = true;
    range: [number, number] = [0, 1];
    private widths: Head | undefined;
    private hovered: Place | undefined;
    onChoose: (place: Place) => void = () => {};

    constructor(host: HTMLElement, private readonly readout: HTMLElement) {
        this.chart = new Chart(host);
        host.tabIndex = 0;
        host.addEventListener("click", (event) => this.click(event));
        host.addEventListener("mousemove", (event) => this.hover(event));
        host.addEventListener("mouseleave", () => this.hover(undefined));
        host.addEventListener("keydown", (event) => this.key(event));
    }

    /** Shows a new response and retains the selected point. */
    take(result: ResponseResult): void {
        const before = this.chosen && this.result?.branches[this.chosen.branch];
        this.hovered = undefined;
        if (before && this.result!.over === result.over) {
            const { point } = this.chosen!;
            this.chosen = nearest(result, before.x[point], before.values.power[point], this.range[1] - this.range[0]);
        } else {
            this.chosen = undefined;
        }
        this.chosen ??= best(result);
        this.result = result;
        this.widths = undefined;
        this.draw();
    }

    takeWidths(head: Head): void {
        this.widths = head;
        this.tell();
    }

    choose(place: Place): void {
        this.chosen = place;
        this.draw();
        this.onChoose(place);
    }

    draw(): void {
        const { result } = this;
        if (!result) return;
        const { words, unit } = QUANTITIES[this.quantity];
        const curves: Curve[] = [];
        if (this.quantity === "power") curves.push({ x: result.linear.x, y: result.linear.power, colour: colour("grey"), width: 1.4 });
        this.pins.forEach((pin, k) => curves.push(...this.lines(pin.result, () => nth(k + 2), 0.55)));
        curves.push(...this.lines(result, (k) => nth(k), 1));
        for (const up of [true, false]) {
            const points = this.swept.filter((point) => point.up === up && point.values[this.quantity] !== undefined);
            curves.push({ x: points.map((p) => p.x), y: points.map((p) => p.values[this.quantity]!), colour: colour(up ? "ink" : "orange"), dots: up ? 2 : 1.5 });
        }
        const marks: Mark[] = result.bifurcations.map((found) => ({ x: found.x, y: found[this.quantity], colour: colour("ink"), shape: SHAPES[found.kind] ?? "cross", size: 3.6 }));
        for (const [place, size] of [[this.hovered, 5], [this.chosen, 7]] as const) {
            const branch = place && result.branches[place.branch];
            if (branch) marks.push({ x: branch.x[place.point], y: branch.values[this.quantity][place.point], colour: colour("vermilion"), shape: "ring", size });
        }
        const rules = this.quantity === "floquet" ? [{ at: 1, along: "y" as const, words: "stable below" }] : [];
        this.chart.show({ words: result.over, unit: result.unit, ends: this.range }, { words, unit, log: this.log }, curves, marks, rules);
        this.tell();
    }

    private lines(result: ResponseResult, own: (k: number) => string, alpha: number): Curve[] {
        return result.branches.map((branch, k) => ({
            x: branch.x,
            y: branch.values[this.quantity],
            colour: own(k),
            width: 2,
            alpha,
            dashed: (from) => !(isStable(branch, from) && isStable(branch, from + 1)),
        }));
    }

    /** Text below the chart: bifurcations, peak and bandwidth. */
    private tell(): void {
        const { result } = this;
        if (!result) return;
        const at = (x: number) => quantity(x, result.unit, 5);
        const parts: string[] = [];
        if (this.widths?.peak) {
            parts.push(`Peak ${quantity(this.widths.peak.mean_power_w, "W")} at ${at(this.widths.peak.parameter)}.`);
            parts.push(`Half-power bandwidth ${at(this.widths.width)}.`);
        }
        const jumps = result.bifurcations.map((found) => `${found.kind} ${at(found.x)}`);
        const shown = [...new Set(jumps)].slice(0, 8);
        if (shown.length > 0) parts.push(`${shown.join(", ")}${jumps.length > shown.length ? ", …" : ""}.`);
        if (result.branches.length === 0) parts.push("No periodic orbit was found in this range.");
        const text = parts.join(" ");
        if (this.readout.textContent !== text) this.readout.textContent = text;
        const count = result.branches.length;
        this.chart.host.setAttribute("aria-label", `${QUANTITIES[this.quantity].words} over ${result.over}: ${count} ${count === 1 ? "branch" : "branches"}. Arrow keys move along the branch. ${text}`);
    }

    private closest(event: MouseEvent): Place | undefined {
        const { over } = this.chart;
        if (!this.result || !over) return undefined;
        const box = over.getBoundingClientRect();
        let found: Place | undefined;
        let least = REACH;
        this.result.branches.forEach((branch, k) => {
            for (let point = 0; point < branch.x.length; point++) {
                const [x, y] = this.chart.place(branch.x[point], branch.values[this.quantity][point]);
                const away = Math.hypot(x + box.left - event.clientX, y + box.top - event.clientY);
                if (away < least) [least, found] = [away, { branch: k, point }];
            }
        });
        return found;
    }

    private click(event: MouseEvent): void {
        const place = this.closest(event);
        if (place) this.choose(place);
    }

    private hover(event: MouseEvent | undefined): void {
        const place = event && this.closest(event);
        if (place?.branch === this.hovered?.branch && place?.point === this.hovered?.point) return;
        this.hovered = place;
        const branch = place && this.result!.branches[place.branch];
        this.chart.host.title = branch
            ? `${quantity(branch.x[place.point], this.result!.unit, 5)}, ${quantity(branch.values.power[place.point], "W")}, period ${branch.period}, ${isStable(branch, place.point) ? "stable" : "unstable"}, ${digits(branch.contacts[place.point])} contacts`
            : "";
        this.draw();
    }

    private key(event: KeyboardEvent): void {
        const { result, chosen } = this;
        const step = { ArrowRight: 1, ArrowLeft: -1, PageUp: 10, PageDown: -10 }[event.key];
        if (!result || !chosen) return;
        let { branch, point } = chosen;
        if (step !== undefined) point = Math.min(Math.max(point + step, 0), result.branches[branch].x.length - 1);
        else if (event.key === "ArrowUp" || event.key === "ArrowDown") {
            branch = (branch + (event.key === "ArrowUp" ? 1 : result.branches.length - 1)) % result.branches.length;
            point = Math.min(point, result.branches[branch].x.length - 1);
        } else return;
        event.preventDefault();
        this.choose({ branch, point });
    }
}
