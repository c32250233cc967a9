// Tabs with arrow keys, following the ARIA authoring practices.

export class Tabs {
    private readonly tabs: HTMLButtonElement[];
    private readonly titles = new Map<HTMLButtonElement, string>();

    constructor(list: HTMLElement, private readonly shown: (id: string) => void) {
        this.tabs = [...list.querySelectorAll<HTMLButtonElement>("[role=tab]")];
        for (const tab of this.tabs) {
            this.titles.set(tab, tab.title);
            tab.onclick = () => this.choose(tab);
            tab.onkeydown = (event) => {
                const open = this.tabs.filter((own) => !own.disabled);
                const [k, count] = [open.indexOf(tab), open.length];
                const next = { ArrowRight: k + 1, ArrowLeft: k - 1 + count, Home: 0, End: count - 1 }[event.key];
                if (next === undefined) return;
                event.preventDefault();
                this.choose(open[next % count]);
            };
        }
    }

    /** Disables tabs for a reason, and enables the others; returns true where the shown one is disabled. */
    disable(ids: string[], reason: string): boolean {
        for (const tab of this.tabs) {
            tab.disabled = ids.includes(tab.id);
            tab.title = tab.disabled ? reason : this.titles.get(tab)!;
        }
        return this.tabs.some((tab) => tab.disabled && tab.ariaSelected === "true");
    }

    /** Element of the shown tab. */
    get shownId(): string {
        return this.tabs.find((tab) => tab.ariaSelected === "true")!.id;
    }

    /** Shows a tab without a change of the focus; returns false where there is none of this id. */
    show(id: string): boolean {
        const tab = this.tabs.find((own) => own.id === id);
        if (tab && !tab.disabled && id !== this.shownId) this.open(tab);
        return tab !== undefined;
    }

    private choose(chosen: HTMLButtonElement): void {
        this.open(chosen);
        chosen.focus();
    }

    private open(chosen: HTMLButtonElement): void {
        for (const tab of this.tabs) {
            tab.setAttribute("aria-selected", String(tab === chosen));
            tab.tabIndex = tab === chosen ? 0 : -1;
            document.getElementById(tab.getAttribute("aria-controls")!)!.hidden = tab !== chosen;
        }
        this.shown(chosen.id);
    }
}
