// What identifies an orbit of a design in any session: the value of the key, the period, and the motion at the start of a drive cycle, in SI. As text, `VALUE:PERIOD:DISPLACEMENT:VELOCITY:VOLTAGE` with the kind of a bifurcation.

import type { Head } from "./frame";

interface Section {
    displacement_m: number;
    velocity_m_s: number;
    voltage_v: number;
}

export interface OrbitIdentity {
    parameter: number;
    period_cycles: number;
    section: Section;
    bifurcation: string | null;
}

/** Digits of the motion: the server compares it to 1e-4. */
const DIGITS = 6;

/** Identity of the orbit of a frame. */
export const identityOf = ({ period_cycles, section, bifurcation }: Head, parameter: number): OrbitIdentity => ({ parameter, period_cycles, section, bifurcation });

export function identityText({ parameter, period_cycles, section, bifurcation }: OrbitIdentity): string {
    const motion = [section.displacement_m, section.velocity_m_s, section.voltage_v].map((value) => Number(value.toPrecision(DIGITS)));
    return [parameter, period_cycles, ...motion, ...(bifurcation ? [bifurcation] : [])].join(":");
}

/** Reads an identity; undefined where the text is none. */
export function readIdentity(text: string): OrbitIdentity | undefined {
    const parts = text.split(":");
    const numbers = parts.slice(0, 5);
    const values = numbers.map(Number);
    const isNumber = numbers.length === 5 && numbers.every((own, k) => own.trim() !== "" && Number.isFinite(values[k]));
    const [parameter, period_cycles, displacement_m, velocity_m_s, voltage_v] = values;
    if (!isNumber || parts.length > 6 || !Number.isInteger(period_cycles) || period_cycles < 1) return undefined;
    return { parameter, period_cycles, section: { displacement_m, velocity_m_s, voltage_v }, bifurcation: parts[5] ?? null };
}
