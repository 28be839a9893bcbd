// SPDX-License-Identifier: MIT
// Formulas are plain text in the sources: AsciiMath reads them, between the marks that Doxygen writes.
MathJax.Hub.Config({
  extensions: ["asciimath2jax.js", "MathEvents.js", "MathMenu.js", "MathZoom.js"],
  jax: ["input/AsciiMath", "output/SVG"],
  asciimath2jax: { delimiters: [["\\[", "\\]"], ["\\(", "\\)"]] },
  SVG: { font: "TeX", linebreaks: { automatic: true, width: "container" }, scale: 95 },
  showMathMenu: false,
  messageStyle: "none",
});
