// SPDX-License-Identifier: GPL-2.0-or-later
// Shows each formula; one that cannot be read stays as it is written, in red.
document.addEventListener("DOMContentLoaded", () => {
  for (const place of document.querySelectorAll(".formula"))
    katex.render(place.textContent.trim(), place, {
      displayMode: place.tagName === "DIV",
      throwOnError: false,
    });
});
