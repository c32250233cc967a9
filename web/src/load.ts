// Mean power over the load: integrated points as they arrive, and the harvester without contact.

import { Chart } from "./chart";
import type { Controls } from "./controls";
import type { Design } from "./design";
import type { Frame } from "./frame";
import type { LegendEntry } from "./legend";
import { colour } from "./theme";
import { quantity } from "./units";
import { Stale } from "./stale";
import type { Request, Wire } from "./wire";

const POINTS = 25;
const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

export class Load {
    private readonly chart = new Chart(find("chart-load"));
    private readonly over = find<HTMLSelectElement>("load-over");
    private readonly words = find("load-words");
    private linear: [Float64Array, Float64Array] = [new Float64Array(0), new Float64Array(0)];
    private points: [number, number][] = [];
    /** Key of the points. */
    private shown = "";
    private running = false;
    private readonly stale: Stale;

    constructor(private readonly wire: Wire, private readonly controls: Controls, private readonly design: Design) {
        this.stale = new Stale(find("panel-load"), find("load-stale"), design);
        wire.on("load", (frame, request) => this.take(frame, request));
        find("load-run").onclick = () => (this.running ? this.stop() : this.run());
    }

    /** Offers the resistances of the design. */
    offer(): void {
        const keys = this.controls.all.map((control) => control.key).filter((key) => /^circuit\..*resistance$/.test(key));
        if (keys.join() === [...this.over.options].map((option) => option.value).join()) return;
        this.over.replaceChildren(...keys.map((key) => new Option(this.controls.title(key), key)));
    }

    run(): void {
        if (!this.over.value) {
            this.words.textContent = "this design has no load resistance";
            return;
        }
        this.set(this.wire.ask("load", { set: this.design.pairs, over: this.over.value, points: POINTS }) !== 0);
        this.words.textContent = "integrating";
        this.redraw();
    }

    private stop(): void {
        this.wire.stop("load");
        this.set(false);
        this.words.textContent = "stopped";
    }

    /** Shows whether the result belongs to the present design. */
    mark(): void {
        this.stale.mark();
    }

    /** The lost connection has taken the computation with it. */
    forget(): void {
        if (!this.running) return;
        this.set(false);
        this.words.textContent = "stopped: the connection was lost";
    }

    private set(running: boolean): void {
        this.running = running;
        find("load-run").textContent = running ? "Stop" : "Run";
    }

    private take(frame: Frame, request: Request): void {
        const { head } = frame;
        if (head.stage === "fault") {
            this.set(false);
            this.words.textContent = head.faults[0]?.message ?? "";
        } else if (head.stage === "linear") {
            this.linear = [frame.array("linear.x"), frame.array("linear.power")];
            this.points = [];
            this.shown = request.body.over;
            this.stale.shows(request);
        } else if (head.stage === "point") {
            this.points.push([head.x, head.power]);
            this.words.textContent = `${this.points.length} of ${head.of} values computed`;
        } else {
            this.set(false);
            const [ohm, watt] = this.points.reduce((most, point) => (point[1] > most[1] ? point : most), [0, 0]);
            this.words.textContent = `largest power: ${quantity(watt, "W")} at ${quantity(ohm, "ohm")}; grey: without contact`;
        }
        this.redraw();
    }

    /** The points, and the power without contact. */
    table(): string | undefined {
        const [x, y] = this.linear;
        if (x.length === 0) return undefined;
        const lines = [...this.points.map((point) => ["integrated", ...point]), ...Array.from(x, (ohm, k) => ["without contact", ohm, y[k]])];
        return `curve,${this.shown}_ohm,mean_power_w\n${lines.map((line) => line.join(",")).join("\n")}\n`;
    }

    /** Legend of the chart. */
    legend(): LegendEntry[] {
        return [{ words: "integrated", colour: colour("blue") }, { words: "without contact", colour: colour("grey") }];
    }

    redraw(): void {
        const [x, y] = this.linear;
        const waits = x.length === 0 || ![...y, ...this.points.map((point) => point[1])].some((watt) => watt > 0);
        this.chart.waiting = waits ? (this.running ? "computing the power" : "no power at any load") : "";
        if (x.length === 0 && !this.running) return;
        const sorted = [...this.points].sort((a, b) => a[0] - b[0]);
        const [px, py] = [sorted.map((point) => point[0]), sorted.map((point) => point[1])];
        this.chart.host.setAttribute("aria-label", `Mean power over ${this.shown}. ${this.words.textContent}`);
        this.chart.show(
            { words: this.controls.title(this.shown || this.over.value), unit: "ohm", log: true, ends: x.length > 0 ? [x[0], x[x.length - 1]] : undefined },
            { words: "Mean power", unit: "W", log: true },
            [{ x, y, colour: colour("grey") }, { x: px, y: py, colour: colour("blue"), width: 1.5 }, { x: px, y: py, colour: colour("blue"), dots: 2.5 }],
        );
    }
}
