// The file of a study: its table, a chart of any two columns, and where both come from.

import { save, saveChart } from "../exports";
import { preparePrints } from "../print";
import { Theme } from "../theme";
import { Choice } from "./choice";
import { origin } from "./origin";
import { Picture, pointWords } from "./picture";
import { Rows } from "./rows";
import { series } from "./series";
import { Table } from "./table";

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

const table = new Table(find("table").textContent!);
const picture = new Picture(find("chart"), (row) => table.isUnsettled(row));
const choice = new Choice(table);
const rows = new Rows(table);

const draw = () => {
    const { view, isLog } = choice;
    const curves = series(table, view);
    picture.show(view, curves, isLog);
    picture.legend(find("legend"));
    const drawn = curves.reduce((sum, own) => sum + own.rows.length, 0);
    find("drawn").textContent = `${drawn} of ${table.rows} points drawn`;
};
const hint = find("cursor").textContent;
picture.onPoint = (row, chosen) => {
    const { view } = choice;
    find("cursor").textContent = row === undefined ? hint : pointWords([...new Set([view.y, ...table.keys, view.x])], row);
    rows.mark(row, chosen);
};
picture.chart.onZoom = () => {
    find("zoom-out").hidden = !picture.chart.isZoomed;
};
find("zoom-out").onclick = () => picture.chart.unzoom();
choice.onChange = draw;
find("csv").onclick = () => save(`${document.title}.csv`, "text/csv", table.toCsv());
find("svg").onclick = () => saveChart(`${document.title}.svg`, picture.chart);
find("print").onclick = () => print();

const words = [`${table.rows} points over ${table.keys.map(({ name }) => name).join(", ")}`];
if (table.failures > 0) words.push(`${table.failures} without a result: the column failure gives the reasons`);
find("summary").textContent = `${words.join("; ")}.`;
origin(table, find("origin"));

const theme = new Theme(find("theme"), () => {
    picture.draw();
    picture.legend(find("legend"));
});
preparePrints(theme, () => [picture.chart]);
draw();
