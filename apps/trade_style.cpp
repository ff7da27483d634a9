#include "apps/trade_page.h"

namespace oro {

// Colours: Okabe and Ito's, which people with any common colour blindness tell apart; darker or lighter where
// the background asks for it.
const char* page_style() {
    return R"(
:root { color-scheme: light dark;
  --paper: #ffffff; --ink: #1b1f24; --soft: #57606a; --line: #d5dae0; --grid: #e4e8ec; --wash: #f5f7f9;
  --band: #eef1f4; --front: #0067a8; --front-wash: #eaf3fa; --other: #76808b; --alarm: #b3261e; --loose: #8a5a00;
  --c0: #b35900; --c1: #0067a8; --c2: #0067a8; --c3: #c24e00; --c4: #007a5a; --c5: #a03c78; --c6: #6b5b00;
  --c7: #2b2f36; }
@media (prefers-color-scheme: dark) { :root {
  --paper: #14171b; --ink: #e4e8ec; --soft: #a0a9b3; --line: #39414a; --grid: #272d34; --wash: #1b2026;
  --band: #20262d; --front: #5cb8f0; --front-wash: #16293a; --other: #8d97a3; --alarm: #ff8a7a; --loose: #e6b450;
  --c0: #f0a040; --c1: #5cb8f0; --c2: #5cb8f0; --c3: #f58a4a; --c4: #35c29a; --c5: #e08cbc; --c6: #e6d35c;
  --c7: #d0d6dd; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink);
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Liberation Sans", "DejaVu Sans", sans-serif; }
main { max-width: 1100px; margin: 0 auto; padding: 32px 30px 64px; }
h1 { font-size: 27px; line-height: 1.25; margin: 0 0 4px; font-weight: 650; }
h2 { font-size: 20px; margin: 44px 0 6px; padding-top: 14px; border-top: 1px solid var(--line); font-weight: 650; }
h3 { font-size: 15.5px; margin: 22px 0 2px; font-weight: 650; }
p { margin: 4px 0 10px; max-width: 82ch; }
.lead, .note, figcaption, caption { color: var(--soft); }
.note { font-size: 13px; }
dl { display: grid; grid-template-columns: max-content 1fr max-content 1fr; gap: 4px 18px; margin: 20px 0 0;
  padding: 14px 18px; background: var(--wash); border: 1px solid var(--line); border-radius: 6px; font-size: 14px; }
dt { color: var(--soft); }
dd { margin: 0; overflow-wrap: anywhere; }
dd.wide { grid-column: 2 / -1; }
code { font: 12.5px/1.5 ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; }
td code { white-space: nowrap; }
sup { line-height: 0; font-size: 11px; }
.findings { margin: 18px 0 0; padding-left: 20px; }
.findings li { margin: 3px 0; max-width: 95ch; }
.alarm, .alarm td, .alarm th { color: var(--alarm); }
.loose { color: var(--loose); }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 512px), 1fr)); gap: 0 16px; }
.plot, .table { overflow-x: auto; }
.plot { margin: 8px 0 6px; }
.plot svg { display: block; }
.keys { display: flex; flex-wrap: wrap; gap: 2px 20px; font-size: 13px; max-width: none; }
.key { vertical-align: -2px; }
svg text { font-size: 12px; fill: var(--ink); }
svg text.tick { fill: var(--soft); }
svg text.title { fill: var(--ink); font-size: 13px; }
svg text.name { fill: var(--soft); stroke: var(--paper); stroke-width: 3px; paint-order: stroke; }
svg text.name.front { fill: var(--front); font-weight: 600; }
svg text.alarm { fill: var(--alarm); font-weight: 600; }
.grid { stroke: var(--grid); }
.band { fill: var(--band); }
.frame { fill: none; stroke: var(--line); }
.leader { stroke: var(--other); stroke-width: 0.8; opacity: 0.7; }
polyline.front { fill: none; stroke: var(--front); stroke-width: 1.6; stroke-linejoin: round; }
.point circle { stroke-width: 1.6; }
.point.front circle { fill: var(--front); stroke: var(--paper); }
.point.other circle { fill: var(--paper); stroke: var(--other); }
.point:hover circle, .point:hover path { stroke: var(--ink); }
.join { stroke: var(--other); stroke-width: 2; }
.join.alarm { stroke: var(--alarm); }
.limit path { stroke: var(--ink); stroke-width: 2; }
g[class*="mark"] path { stroke: var(--paper); stroke-width: 0.8; }
.mark0 path { fill: var(--c0); } .mark1 path { fill: var(--c1); } .mark2 path { fill: var(--c2); }
.mark3 path { fill: var(--c3); } .mark4 path { fill: var(--c4); } .mark5 path { fill: var(--c5); }
.mark6 path { fill: var(--c6); } .mark7 path { fill: var(--c7); }
g.many[class*="mark"] path { fill-opacity: 0.4; stroke: none; }
g.missing[class*="mark"] path { fill: var(--band); stroke: var(--soft); stroke-width: 1.4; }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums; width: 100%;
  margin: 8px 0 12px; }
caption { text-align: left; font-size: 13px; padding-bottom: 6px; }
th, td { padding: 4px 9px; text-align: right; border-bottom: 1px solid var(--grid); white-space: nowrap;
  font-weight: normal; vertical-align: top; }
thead th { color: var(--soft); vertical-align: bottom; border-bottom-color: var(--line); line-height: 1.3; }
thead th[colspan] { text-align: center; }
th.text, td.text { text-align: left; }
td.text { white-space: normal; overflow-wrap: break-word; }
tr.front { background: var(--front-wash); }
tr.front th, tr.front td:first-child { color: var(--front); font-weight: 600; }
td.none { color: var(--soft); }
tbody tr:hover { background: var(--wash); }
abbr { text-decoration: none; }
details { margin: 12px 0; }
summary { cursor: pointer; color: var(--front); font-size: 14px; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 420px), 1fr)); gap: 22px; }
figure { margin: 8px 0; }
figure img { display: block; width: 100%; height: auto; border: 1px solid var(--line); background: var(--wash); }
figcaption { font-size: 13px; margin-top: 6px; }
figcaption strong { color: var(--ink); display: block; font-size: 14px; }
@media (max-width: 700px) { main { padding: 20px 14px 40px; } dl { grid-template-columns: max-content 1fr; } }
@media print { main { max-width: none; padding: 0; } section { break-inside: avoid-page; } }
)";
}

}  // namespace oro
