// SPDX-License-Identifier: Apache-2.0
// Long tables: a click on a heading sorts, a word filters the rows.
"use strict";
(() => {
  const value = (row, column) => {
    const text = row.cells[column].textContent.trim(), number = Number(text);
    return text !== "" && !Number.isNaN(number) ? number : text;
  };
  const compare = (a, b) => {
    if (typeof a === typeof b) return typeof a === "number" ? a - b : a.localeCompare(b, undefined, {numeric: true});
    return typeof a === "number" ? -1 : 1;
  };
  for (const box of document.querySelectorAll(".sortable")) {
    const table = box.querySelector("table"), body = table.tBodies[0], all = [...body.rows];
    const find = document.createElement("input"), count = document.createElement("span");
    find.type = "search";
    find.placeholder = "Filter";
    find.setAttribute("aria-label", "Show only rows with these words");
    count.className = "muted";
    count.setAttribute("role", "status");
    box.prepend(find, count);
    const filter = () => {
      const words = find.value.toLowerCase().split(/\s+/).filter(Boolean);
      let shown = 0;
      for (const row of all) {
        const text = row.textContent.toLowerCase();
        row.hidden = !words.every((word) => text.includes(word));
        shown += row.hidden ? 0 : 1;
      }
      count.textContent = ` ${shown} of ${all.length}`;
    };
    find.addEventListener("input", filter);
    filter();
    [...table.tHead.rows[0].cells].forEach((head, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.className = "sort";
      button.append(...head.childNodes);
      head.append(button);
      button.addEventListener("click", () => {
        const down = head.getAttribute("aria-sort") === "ascending";
        for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
        head.setAttribute("aria-sort", down ? "descending" : "ascending");
        all.sort((a, b) => compare(value(a, column), value(b, column)) * (down ? -1 : 1));
        body.append(...all);
      });
    });
  }
})();
