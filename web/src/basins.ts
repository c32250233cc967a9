// Basins of attraction: plane of displacement and velocity, coloured by attractor, with fractions and expected power.

import { Chart } from "./chart";
import type { Design } from "./design";
import type { Frame } from "./frame";
import { colour, nth } from "./theme";
import { digits, quantity } from "./units";
import type { Wire } from "./wire";

interface Attractor {
    id: string;
    mean_power_w: number;
    fraction: number;
    fraction_low: number;
    fraction_high: number;
}

/** Coarser than the default 1e-8 of `jounce basins`: the page shows the shape of the basins within seconds. */
const TOLERANCE = 1e-6;
const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

export class Basins {
    private readonly chart = new Chart(find("chart-basins"));
    private readonly words = find("basins-words");
    private readonly bar = find<HTMLProgressElement>("basins-progress");
    private frame: Frame | undefined;
    private running = false;

    constructor(private readonly wire: Wire, private readonly design: Design) {
        wire.on("basins", (frame) => this.take(frame));
        find("basins-run").onclick = () => (this.running ? this.stop() : this.run());
    }

    run(): void {
        const starts = Number(find<HTMLSelectElement>("basins-starts").value);
        this.set(this.wire.ask("basins", { set: this.design.pairs, starts, tolerance: TOLERANCE }) !== 0);
        this.bar.value = 0;
        this.words.textContent = "integrating";
    }

    private stop(): void {
        this.wire.ask("stop", { what: "basins" });
        this.set(false);
        this.words.textContent = "stopped";
    }

    private set(running: boolean): void {
        this.running = running;
        this.bar.hidden = !running;
        find("basins-run").textContent = running ? "Stop" : "Run";
    }

    private take(frame: Frame): void {
        const { head } = frame;
        if (head.stage === "fault") {
            this.set(false);
            this.words.textContent = head.faults[0]?.message ?? "";
        } else if (head.stage === "progress") {
            this.bar.value = head.done / head.of;
            const left = (head.seconds / head.done) * (head.of - head.done);
            this.words.textContent = `${head.done} of ${head.of} starts, ${digits(left, 2)} s left`;
        } else {
            this.set(false);
            this.frame = frame;
            const expected = quantity(head.expected_power_w, "W");
            this.words.textContent = `at ${quantity(head.frequency_hz, "Hz")}: expected power ${expected}${head.failed.length > 0 ? `, ${head.failed.length} runs failed` : ""}`;
            this.redraw();
        }
    }

    redraw(): void {
        if (!this.frame) return;
        const { head } = this.frame;
        const attractors = head.attractors as Attractor[];
        const [x, y, attractor] = ["displacement_m", "velocity_m_s", "attractor"].map((name) => this.frame!.array(name));
        const size = Math.max(1.5, (0.46 * Math.min(this.chart.host.clientWidth - 70, this.chart.host.clientHeight - 46)) / Math.sqrt(head.starts));
        const curves = [...attractors.keys(), -1].map((k) => {
            const own = [...attractor.keys()].filter((index) => attractor[index] === k);
            return { x: own.map((index) => x[index]), y: own.map((index) => y[index]), colour: k < 0 ? colour("grey") : nth(k), dots: size };
        });
        this.chart.show({ words: "Displacement", unit: "m" }, { words: "Velocity", unit: "m/s" }, curves);
        const share = (value: number) => `${digits(100 * value, 3)} %`;
        const legend = attractors.map((a, k) => {
            const item = document.createElement("li");
            item.dataset.colour = String(k % 6);
            item.textContent = `${a.id}: ${share(a.fraction)} of the starts (${share(a.fraction_low)} to ${share(a.fraction_high)}), ${quantity(a.mean_power_w, "W")}`;
            return item;
        });
        find("attractors").replaceChildren(...legend);
        this.chart.host.setAttribute("aria-label", `Attractors of ${x.length} starts. ${legend.map((item) => item.textContent).join("; ")}`);
    }
}
