// Rows of the table below the chart, sorted by any column.

import { digits } from "../units";
import { type Column, type Table, scale } from "./table";

/** Rows that are added at once. */
const BLOCK = 200;
const DIGITS = 6;

export class Rows {
    private shown = BLOCK;
    private sorted: { column: Column; down: boolean } | undefined;
    private order: number[] = [];
    /** Divisor and unit of each column, as on the axes of the chart. */
    private readonly scales: Map<Column, [number, string]>;
    private readonly head = document.querySelector<HTMLElement>("#rows thead tr")!;
    private readonly body = document.querySelector<HTMLElement>("#rows tbody")!;
    private readonly host = document.getElementById("scroll")!;
    private readonly more = document.getElementById("more") as HTMLButtonElement;

    constructor(private readonly table: Table) {
        this.scales = new Map(table.columns.map((column) => [column, scale(column)]));
        this.head.replaceChildren(...table.columns.map((column) => this.heading(column)));
        this.more.onclick = () => {
            this.shown += BLOCK;
            this.draw();
        };
        document.getElementById("rows")!.classList.toggle("complete", table.failures === 0);
        this.sort();
    }

    private heading(column: Column): HTMLElement {
        const cell = document.createElement("th");
        cell.className = looks(column);
        const button = document.createElement("button");
        // A long name may be broken after a point or an underscore.
        column.name.split(/(?<=[._])/).forEach((part, k) => button.append(...(k > 0 ? [document.createElement("wbr")] : []), part));
        button.title = `${column.about}; click to sort`;
        button.onclick = () => {
            this.sorted = { column, down: this.sorted?.column === column && !this.sorted.down };
            this.sort();
        };
        cell.append(button);
        const unit = document.createElement("span");
        unit.textContent = this.scales.get(column)![1];
        cell.append(unit);
        return cell;
    }

    private sort(): void {
        this.order = Array.from({ length: this.table.rows }, (_, row) => row);
        if (this.sorted) {
            const { column, down } = this.sorted;
            const side = down ? -1 : 1;
            const { cells, values } = column;
            // Numbers without a value come last in both directions.
            const compare = (a: number, b: number) => (column.kind === "text" ? side * String(cells[a]).localeCompare(String(cells[b])) : Number(Number.isNaN(values[a])) - Number(Number.isNaN(values[b])) || side * (values[a] - values[b]));
            this.order.sort((a, b) => compare(a, b) || a - b);
        }
        this.table.columns.forEach((column, k) => {
            const isSorted = this.sorted?.column === column;
            this.head.children[k].setAttribute("aria-sort", isSorted ? (this.sorted!.down ? "descending" : "ascending") : "none");
        });
        this.draw();
    }

    private draw(): void {
        this.body.replaceChildren(...this.order.slice(0, this.shown).map((row) => this.row(row)));
        const rest = this.order.length - this.shown;
        this.more.hidden = rest <= 0;
        this.more.textContent = `Show ${Math.min(rest, BLOCK)} of ${rest} more rows`;
    }

    private row(row: number): HTMLElement {
        const line = document.createElement("tr");
        line.dataset.row = String(row);
        for (const column of this.table.columns) {
            const cell = document.createElement("td");
            cell.className = looks(column);
            cell.textContent = text(column, row, this.scales.get(column)![0]);
            line.append(cell);
        }
        return line;
    }

    /** Marks the row of a point, if it is shown. */
    mark(row: number | undefined, scroll = false): void {
        this.body.querySelector(".marked")?.classList.remove("marked");
        const line = this.body.querySelector(`[data-row="${row}"]`);
        line?.classList.add("marked");
        // Only the table scrolls: the chart stays in view.
        if (scroll && line instanceof HTMLElement) this.host.scrollTop = line.offsetTop - this.host.clientHeight / 2;
    }
}

/** Classes of the cells of a column. */
function looks({ kind, name }: Column): string {
    return `${kind === "text" ? "words" : ""} ${name === "failure" ? "failure" : ""}`.trim();
}

function text({ kind, cells, values }: Column, row: number, step: number): string {
    if (kind === "text") return String(cells[row]);
    if (kind === "flag") return cells[row] ? "yes" : "no";
    return Number.isFinite(values[row]) ? digits(values[row] / step, DIGITS) : Number.isNaN(values[row]) ? "–" : values[row] > 0 ? "∞" : "−∞";
}
