// Tabs with arrow keys, following the ARIA authoring practices.

export class Tabs {
    private readonly tabs: HTMLButtonElement[];

    constructor(list: HTMLElement, private readonly shown: (id: string) => void) {
        this.tabs = [...list.querySelectorAll<HTMLButtonElement>("[role=tab]")];
        this.tabs.forEach((tab, k) => {
            tab.onclick = () => this.choose(k);
            tab.onkeydown = (event) => {
                const count = this.tabs.length;
                const next = { ArrowRight: k + 1, ArrowLeft: k - 1 + count, Home: 0, End: count - 1 }[event.key];
                if (next === undefined) return;
                event.preventDefault();
                this.choose(next % count);
            };
        });
    }

    private choose(chosen: number): void {
        this.tabs.forEach((tab, k) => {
            tab.setAttribute("aria-selected", String(k === chosen));
            tab.tabIndex = k === chosen ? 0 : -1;
            document.getElementById(tab.getAttribute("aria-controls")!)!.hidden = k !== chosen;
        });
        this.tabs[chosen].focus();
        this.shown(this.tabs[chosen].id);
    }
}
