// A table of measured points: text with commas, semicolons or tabs, whose first line names the columns with their units.

import type { Quantity } from "./branches";

export interface Series {
    quantity: Quantity;
    /** Name of the column. */
    words: string;
    hertz: number[];
    /** Values, SI. */
    values: number[];
}

export interface Column {
    words: string;
    /** Name without its unit. */
    name: string;
    /** Kind and size of the unit; undefined without a known one. */
    unit: Unit | undefined;
}

interface Unit {
    kind: "frequency" | "time" | "power" | "voltage" | "length" | "force" | "speed" | "strain";
    size: number;
}

/** Largest number of points of a file. */
const MOST_POINTS = 20_000;

const PREFIXES: Record<string, number> = { p: 1e-12, n: 1e-9, u: 1e-6, "µ": 1e-6, "μ": 1e-6, m: 1e-3, k: 1e3, "": 1 };
const BASES: Record<string, Unit["kind"]> = { Hz: "frequency", s: "time", W: "power", V: "voltage", m: "length", N: "force", "m/s": "speed" };
const OTHERS: Record<string, Unit> = {
    rpm: { kind: "frequency", size: 1 / 60 }, "rad/s": { kind: "frequency", size: 1 / (2 * Math.PI) }, cm: { kind: "length", size: 0.01 },
    ppm: { kind: "strain", size: 1e-6 }, "µm/m": { kind: "strain", size: 1e-6 }, "um/m": { kind: "strain", size: 1e-6 },
};

function unitOf(sign: string): Unit | undefined {
    if (OTHERS[sign]) return OTHERS[sign];
    for (const [base, kind] of Object.entries(BASES)) {
        const size = sign.endsWith(base) ? PREFIXES[sign.slice(0, sign.length - base.length)] : undefined;
        if (size !== undefined) return { kind, size };
    }
    return undefined;
}

/** Units as the last part of a name: `mean_power_w`, `velocity_m_s`. */
const SUFFIXES: Record<string, string> = { hz: "Hz", khz: "kHz", s: "s", ms: "ms", w: "W", mw: "mW", uw: "uW", nw: "nW", v: "V", mv: "mV", m: "m", mm: "mm", um: "um", n: "N", mn: "mN", m_s: "m/s", ppm: "ppm", rpm: "rpm" };

/** Forms of a title with its unit at the end: "Power (µW)", "power [uW]", "power in uW", "power / uW", "power, uW", "power uW". */
const TITLES = [/^(.*?)\s*[([]\s*([^)\]]*?)\s*[)\]]$/, /^(.*?)\s+in\s+(\S+)$/, /^(.*?)\s*[/,]\s*(\S+)$/, /^(.*?)\s+(\S+)$/];

/** A column by its title. */
export function columnOf(title: string): Column {
    const words = title.trim();
    for (const form of TITLES) {
        const [, name, sign] = form.exec(words) ?? [];
        const unit = sign === undefined ? undefined : unitOf(sign) ?? unitOf(SUFFIXES[sign.toLowerCase()] ?? "");
        if (unit) return { words, name, unit };
    }
    const [, name, suffix] = /^(.*?)_(m_s|[a-z]+)$/i.exec(words) ?? [];
    return { words, name: name ?? words, unit: unitOf(SUFFIXES[suffix?.toLowerCase()] ?? "") };
}

/** The quantity of a column, with a factor to SI; a text says why the response cannot show it. */
function quantityOf({ words, name, unit }: Column): [Quantity, number] | string | undefined {
    const isPeakToPeak = /peak.?to.?peak|pk.?pk|\bp-?p\b|_pp\b/i.test(name);
    if (unit?.kind === "power") return ["power", unit.size];
    if (unit?.kind === "voltage") {
        const isPeak = isPeakToPeak || /peak|\bpk\b|max|amplitude/i.test(name);
        return isPeak ? `column “${words}”: the response shows the rms of the voltage; give that column as rms` : ["voltage", unit.size];
    }
    if (unit?.kind === "length") {
        if (/rms/i.test(name)) return `column “${words}”: the response shows the amplitude, half peak to peak; give that column as one`;
        return [/penetration/i.test(name) ? "penetration" : "displacement", isPeakToPeak ? 0.5 * unit.size : unit.size];
    }
    return undefined;
}

/** Cells of a line; quotes may enclose one. */
function cells(line: string, separator: string): string[] {
    const found: string[] = [];
    let [cell, quoted] = ["", false];
    for (const letter of line) {
        if (letter === '"') quoted = !quoted;
        else if (letter !== separator || quoted) cell += letter;
        else {
            found.push(cell);
            cell = "";
        }
    }
    return [...found, cell].map((own) => own.trim());
}

/** The number in a cell; undefined in an empty one, a text where it is none. */
function numberOf(cell: string, hasDecimalCommas: boolean): number | undefined | string {
    if (cell === "" || /^nan$/i.test(cell)) return undefined;
    const value = Number(hasDecimalCommas ? cell.replace(",", ".") : cell);
    return Number.isFinite(value) ? value : cell;
}

interface Table {
    columns: Column[];
    /** Number of the line and its cells. */
    rows: { line: number; cells: string[] }[];
    hasDecimalCommas: boolean;
}

/** Columns and rows of a text; lines that begin with # or % are comments. */
export function tableOf(text: string): Table {
    const lines = text.replace(/^\uFEFF/, "").split(/\r\n|\n|\r/);
    const used = lines.map((own, k) => ({ line: k + 1, own })).filter(({ own }) => own.trim() !== "" && !/^\s*[#%]/.test(own));
    const title = used[0]?.own ?? "";
    const separator = title.includes("\t") ? "\t" : title.includes(";") ? ";" : ",";
    const rows = used.slice(1).map(({ line, own }) => ({ line, cells: cells(own, separator) }));
    return { columns: cells(title, separator).map(columnOf), rows, hasDecimalCommas: separator !== "," };
}

/** Series of a table, or words about its fault. */
export function measuredSeries({ columns, rows, hasDecimalCommas }: Table): Series[] | string {
    const example = "such as frequency (Hz), power (µW)";
    if (columns.every(({ words }) => words === "" || Number.isFinite(Number(words)))) return `the first line must name the columns with their units, ${example}`;
    const frequencies = columns.flatMap(({ unit }, k) => (unit?.kind === "frequency" ? [k] : []));
    if (frequencies.length === 0) return `no column has a unit of frequency; its name must end in one, ${example}`;
    if (frequencies.length > 1) return `two columns are frequencies, “${columns[frequencies[0]].words}” and “${columns[frequencies[1]].words}”; keep one`;
    const shown = columns.map(quantityOf);
    const refused = shown.find((own) => typeof own === "string");
    if (refused) return refused;
    if (!shown.some((own) => own !== undefined)) return `no column is a power, voltage or displacement; its name must end in a unit, ${example}`;
    if (rows.length > MOST_POINTS) return `the file has ${rows.length} lines; the page shows at most ${MOST_POINTS}`;
    const series = new Map<number, Series>();
    for (const { line, cells } of rows) {
        if (cells.length !== columns.length) return `line ${line} has ${cells.length} ${cells.length === 1 ? "value" : "values"}, the first line ${columns.length} columns`;
        const numbers = cells.map((cell) => numberOf(cell, hasDecimalCommas));
        for (const [k, column] of columns.entries()) {
            const own = shown[k] as [Quantity, number] | undefined;
            if (k !== frequencies[0] && !own) continue;
            if (typeof numbers[k] === "string") return `line ${line}, column “${column.words}”: “${numbers[k]}” is not a number`;
            const hertz = numbers[frequencies[0]];
            if (!own || numbers[k] === undefined || typeof hertz !== "number") continue;
            const list = series.get(k) ?? { quantity: own[0], words: column.words, hertz: [], values: [] };
            series.set(k, list);
            list.hertz.push(hertz * columns[frequencies[0]].unit!.size);
            list.values.push((numbers[k] as number) * own[1]);
        }
    }
    return series.size > 0 ? [...series.values()] : "the file has no point with a frequency and a value";
}
