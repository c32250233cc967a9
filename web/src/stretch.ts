// A stretch of a motion without a period, in the charts of the orbit: its Poincaré section in the phase portrait, and its time history.

import type { Chart } from "./chart";
import type { Frame } from "./frame";
import { colour } from "./theme";

export interface StretchCharts {
    displacement: Chart;
    phase: Chart;
    voltage: Chart;
}

/** Size of a point of the section. */
const DOT = 1.6;

export function drawStretch(frame: Frame, { displacement, phase, voltage }: StretchCharts): void {
    const { head } = frame;
    const gap = (along: "x" | "y") => (head.gap_m === null ? [] : [{ at: head.gap_m as number, along, words: "stop" }]);
    const seconds = { words: "Time", unit: "s" };
    const [time, blue] = [frame.array("time"), colour("blue")];
    displacement.host.hidden = phase.host.hidden = false;
    displacement.show(seconds, { words: "Position", unit: "m" }, [{ x: time, y: frame.array("history.displacement"), colour: blue }], [], gap("y"));
    phase.show({ words: "Displacement", unit: "m", room: true }, { words: "Velocity", unit: "m/s" }, [{ x: frame.array("section.displacement"), y: frame.array("section.velocity"), colour: blue, dots: DOT }]);
    voltage.show(seconds, { words: "Voltage", unit: "V" }, [{ x: time, y: frame.array("history.voltage"), colour: colour("green") }]);
    const label = (chart: Chart, words: string) => chart.host.setAttribute("aria-label", words);
    label(displacement, `Displacement towards the stop over ${head.history_cycles} drive cycles`);
    label(phase, `Poincaré section: velocity over displacement at the start of each of ${head.cycles} drive cycles`);
    label(voltage, `Voltage over ${head.history_cycles} drive cycles`);
}

/** What the charts show. */
export const stretchWords = ({ head }: Frame): string =>
    `${head.cycles} drive cycles from a start that reached it: Poincaré section, a point at the start of each cycle; histories of the first ${head.history_cycles}. Longer motions may show more.`;
