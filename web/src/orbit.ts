// Orbit of the selected point: histories, phase portrait, spectrum, force, multipliers, and the motion of the beam.

import { AROUND, Chart } from "./chart";
import type { Frame } from "./frame";
import { Motion } from "./motion";
import { colour, nth } from "./theme";
import { digits, quantity } from "./units";

const find = (id: string) => document.getElementById(id)!;

export class Orbit {
    readonly motion = new Motion(find("motion") as HTMLCanvasElement);
    private readonly displacement = new Chart(find("chart-displacement"), true);
    private readonly phase = new Chart(find("chart-phase"), true);
    private readonly voltage = new Chart(find("chart-voltage"), true);
    private readonly force = new Chart(find("chart-force"), true);
    private readonly spectrum = new Chart(find("chart-spectrum"), true);
    private readonly multipliers = new Chart(find("chart-multipliers"), true);
    private readonly title = find("orbit-title");
    private frame: Frame | undefined;

    constructor() {
        const slow = find("slow") as HTMLInputElement;
        const pace = () => {
            this.motion.slower = 10 ** Number(slow.value);
            slow.setAttribute("aria-valuetext", `${digits(this.motion.slower, 2)} times slower`);
        };
        slow.oninput = pace;
        pace();
        const play = find("play") as HTMLButtonElement;
        const show = (playing: boolean) => {
            play.textContent = playing ? "Pause" : "Play";
            play.setAttribute("aria-pressed", String(playing));
        };
        play.onclick = () => show(this.motion.toggle());
        show(this.motion.playing);
    }

    take(frame: Frame): void {
        this.frame = frame;
        this.motion.take(frame);
        this.draw();
    }

    redraw(): void {
        if (this.frame) this.draw();
    }

    private draw(): void {
        const frame = this.frame!;
        const { head } = frame;
        const [time, stops] = [frame.array("time"), head.stops as { name: string; gap: number }[]];
        const seconds = { words: "Time", unit: "s", ends: [0, head.period_s] as [number, number] };
        const own = (name: string) => stops.map((_, k) => ({ y: frame.array(`${name}.${k}`), colour: nth(k) }));
        const gaps = stops.map((stop) => stop.gap);
        this.title.textContent = `Orbit at ${quantity(head.parameter, head.unit, 5)}: ${quantity(head.mean_power_w, "W")}, period ${head.period_cycles}, ${head.stable ? "stable" : "unstable"}`;
        const contacts = `${head.contacts} ${head.contacts === 1 ? "contact" : "contacts"} per period`;
        this.displacement.show(seconds, { words: "Position", unit: "m" }, own("displacement").map((curve) => ({ x: time, ...curve })), [], gaps.map((at) => ({ at, along: "y", words: "stop" })));
        this.phase.show(
            { words: "Displacement", unit: "m" },
            { words: "Velocity", unit: "m/s" },
            stops.map((_, k) => ({ x: closed(frame.array(`displacement.${k}`)), y: closed(frame.array(`velocity.${k}`)), colour: nth(k) })),
            [],
            gaps.map((at) => ({ at, along: "x", words: "stop" })),
        );
        this.voltage.show(seconds, { words: "Voltage", unit: "V" }, [{ x: time, y: frame.array("voltage"), colour: colour("green") }]);
        this.force.show(seconds, { words: "Force", unit: "N" }, own("force").map((curve) => ({ x: time, ...curve, colour: colour("vermilion") })));
        const lines = frame.array("spectrum.amplitude");
        const most = lines.reduce((high, value) => Math.max(high, value), 1e-12);
        this.spectrum.show({ words: "Frequency", unit: "Hz" }, { words: "Voltage, peak", unit: "V", log: true, ends: [1e-5 * most, 2 * most] }, [{ x: frame.array("spectrum.frequency"), y: lines.map((value) => Math.max(value, 1e-6 * most)), colour: colour("purple"), stems: true }]);
        this.circle(frame);
        this.label(this.displacement, `Displacement towards the stop over one period: ${contacts}, largest penetration ${quantity(head.max_penetration_m, "m")}`);
        this.label(this.phase, "Phase portrait: velocity over displacement, with the stop as a line");
        this.label(this.voltage, `Voltage over one period: ${quantity(head.voltage_rms_v, "V")} rms`);
        this.label(this.force, `Contact force over one period: ${contacts}`);
        this.label(this.spectrum, "Spectrum of the voltage, up to twelve times the drive frequency");
        this.label(this.multipliers, `Floquet multipliers and the unit circle: largest modulus ${digits(head.floquet_max_abs)}, ${head.stable ? "stable" : "unstable"}`);
    }

    private circle(frame: Frame): void {
        const [re, im] = [frame.array("multiplier.re"), frame.array("multiplier.im")];
        const host = this.multipliers.host;
        const reach = Math.max(1.15, 1.1 * frame.head.floquet_max_abs);
        // Equal scales make the circle round.
        const wide = (reach * Math.max(20, host.clientWidth - AROUND[0])) / Math.max(20, host.clientHeight - AROUND[1]);
        const marks = Array.from(re, (x, k) => ({ x, y: im[k], colour: colour(Math.hypot(x, im[k]) < 1 ? "blue" : "vermilion"), shape: "circle" as const, size: 3 }));
        this.multipliers.show({ words: "Multipliers, real", unit: "", ends: [-wide, wide] }, { words: "imaginary", unit: "", ends: [-reach, reach] }, [], marks, [], true);
    }

    private label(chart: Chart, words: string): void {
        chart.host.setAttribute("aria-label", words);
    }
}

/** Appends the first value to close a curve. */
function closed(values: Float64Array): number[] {
    return [...values, values[0]];
}
