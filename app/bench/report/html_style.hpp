#pragma once
#include <string_view>

namespace clay::bench {

/// CSS of the page, for light and dark themes, screen and print; the drawings have their own.
inline constexpr std::string_view kPageStyle = R"css(
:root { color-scheme: light dark; --ink: #24211e; --soft: #5e5850; --rule: #d8d2c8; --page: #ffffff;
  --head: #f6f3ee; --bad: #b3261e; --good: #1c6b3c; --accent: #9a4a1c; }
@media screen and (prefers-color-scheme: dark) { :root { --ink: #e4e1dc; --soft: #a8a29a;
  --rule: #3a3f45; --page: #16191d; --head: #20242a; --bad: #ff8a80; --good: #7fd8a0;
  --accent: #f0a070; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 2rem 1.2rem 4rem; max-width: 62rem; background: var(--page);
  color: var(--ink); font: 16px/1.5 system-ui, "DejaVu Sans", Arial, sans-serif; }
h1 { font-size: 1.7rem; margin: 0 0 0.6rem; } h2 { font-size: 1.35rem; margin: 3rem 0 0.5rem;
  padding-top: 1.2rem; border-top: 2px solid var(--rule); }
h3 { font-size: 1.02rem; margin: 1.8rem 0 0.4rem; }
p { margin: 0.5rem 0; max-width: 46rem; } .note { color: var(--soft); font-size: 0.9rem; }
nav a { margin-right: 1.1rem; white-space: nowrap; } a { color: var(--accent); }
code { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: 0.88em;
  overflow-wrap: anywhere; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 0.15rem 1rem; margin: 0.8rem 0; }
dt { color: var(--soft); } dd { margin: 0; overflow-wrap: anywhere; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.9rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.22rem 0.7rem; border-bottom: 1px solid var(--rule); text-align: left;
  vertical-align: top; }
th { background: var(--head); font-weight: 600; vertical-align: bottom; }
th small { display: block; color: var(--soft); font-weight: 400; }
.wide { font-size: 0.78rem; } .wide th, .wide td { padding: 0.18rem 0.4rem; }
.number { text-align: right; white-space: nowrap; } .spread { color: var(--soft); }
.no { color: var(--bad); font-weight: 600; } .yes { color: var(--good); }
.verdict { font-size: 0.8rem; font-weight: 600; margin-left: 0.6rem; }
figure { margin: 1.6rem 0; } figcaption { font-weight: 600; margin-bottom: 0.3rem; }
svg.plot { width: 100%; max-width: 760px; height: auto; display: block; }
@media print { body { max-width: none; padding: 0; font-size: 11pt; } nav { display: none; }
  figure, tr { break-inside: avoid; } .scroll { overflow: visible; } .wide { font-size: 7pt; } h2, h3, figcaption { break-after: avoid; } }
)css";

}  // namespace clay::bench
