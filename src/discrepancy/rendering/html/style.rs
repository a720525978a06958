//! The look of the page; no quotation marks and no comparison signs, so that nothing needs escaping.

use crate::picture::theme;

const PAGE: &str = "\
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%;scroll-behavior:smooth}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,-apple-system,Segoe UI,Roboto,Helvetica Neue,Arial,sans-serif}
main{max-width:1120px;margin:0 auto;padding:32px 28px 64px}
a{color:var(--after)}
:focus-visible{outline:3px solid var(--after);outline-offset:2px}
[hidden]{display:none!important}
.eyebrow{margin:0 0 14px;color:var(--soft);font-size:14px}
.verdict{display:inline-block;margin:0 10px 4px 0;padding:2px 12px;border:1.5px solid currentColor;border-radius:99px;font-weight:650;color:var(--warn)}
.verdict.good{color:var(--good)}
.verdict.bad{color:var(--bad)}
h1{margin:0;max-width:30em;font-size:clamp(22px,3vw,32px);line-height:1.22;font-weight:650;letter-spacing:-.012em;text-wrap:balance;overflow-wrap:anywhere}
.whole{white-space:nowrap}
h2{margin:0 0 12px;font-size:20px;line-height:1.3;font-weight:650}
h3{margin:14px 0 6px;font-size:15px;font-weight:650}
.lead{margin:12px 0 0;max-width:62em;color:var(--soft)}
main section,nav{margin:34px 0 0}
.cards{display:grid;grid-template-columns:1.5fr 1fr 1fr;gap:14px;margin:24px 0 0}
.card{margin:0!important;min-width:0;padding:14px 16px;border:1px solid var(--rule);border-radius:10px}
.card h2{margin:0 0 8px;font-size:13.5px;font-weight:600;color:var(--soft)}
.bar{display:grid;grid-template-columns:84px 1fr auto;gap:10px;align-items:center;margin:5px 0;font-size:14px}
.bar b{font-weight:650;font-variant-numeric:tabular-nums;min-width:4.6em;text-align:right}
.track{display:block}
.bar i{display:block;height:12px;border-radius:3px;background:var(--floor)}
.bar i.before{background:var(--before)}
.bar i.after{background:var(--after)}
.bar i.floor{border-radius:0;background:repeating-linear-gradient(90deg,var(--floor) 0 3px,transparent 3px 5px)}
.big{margin:0;font-size:25px;line-height:1.2;font-weight:650;letter-spacing:-.01em;text-wrap:balance}
.small{margin:6px 0 0;font-size:14px;color:var(--soft);overflow-wrap:anywhere}
.columns{display:grid;grid-template-columns:minmax(0,1fr);gap:18px}
@media (min-width:900px){.columns:has(.texts):has(.next){grid-template-columns:minmax(0,2fr) minmax(0,1fr)}}
.text{position:relative}
pre{margin:0;padding:12px 14px;overflow-x:auto;border-radius:8px;background:var(--panel);white-space:pre-wrap;overflow-wrap:anywhere}
pre,code{font:14px/1.5 ui-monospace,SFMono-Regular,Menlo,Consolas,Liberation Mono,monospace}
code{overflow-wrap:anywhere}
button,select{font:inherit;font-size:14px;min-height:34px;padding:4px 11px;border:1px solid var(--soft);border-radius:6px;background:var(--paper);color:var(--ink);cursor:pointer;max-width:100%}
button[aria-selected=true],button[aria-pressed=true]{background:var(--ink);color:var(--paper)}
.tabs{display:flex;flex-wrap:wrap;gap:4px;margin:0 0 8px}
.copy{position:absolute;top:6px;right:6px}
.next{margin:0;padding:12px 18px;border-left:5px solid var(--after);background:var(--panel);align-self:start}
.next p{margin:4px 0 0}
.next strong{font-weight:650}
.tools{display:flex;flex-wrap:wrap;gap:6px;align-items:center;margin:0 0 8px}
.tools label{font-size:14px;margin-right:8px;max-width:100%}
.tools .small{margin:0 2px 0 0}
.map{position:relative;border:1px solid var(--rule);border-radius:10px;overflow:hidden}
#map{touch-action:pan-y pinch-zoom;cursor:crosshair}
.scale{position:absolute;left:14px;bottom:10px;padding:0 0 1px 5px;border:solid var(--ink);border-width:0 1.5px 1.5px;font-size:13px;line-height:1.2;white-space:nowrap;background:color-mix(in srgb,var(--paper) 75%,transparent)}
.casing,.error{fill:none;stroke-linecap:round;stroke-linejoin:round}
.casing{stroke:var(--ink);stroke-width:10.5;opacity:.8}
ERRORS.robot{fill:var(--ink);stroke:var(--paper);stroke-width:1.5}
.line.ahead{stroke:var(--ink);stroke-width:2.5;stroke-dasharray:.1 5}
#ghosts .line.before{stroke-width:3}
#ghosts .line.after{stroke-width:3}
.scope{fill:var(--band);fill-opacity:.6;stroke:var(--soft);stroke-dasharray:4 4}
.legend{display:flex;flex-wrap:wrap;gap:4px 20px;margin:8px 0 0;font-size:14px;color:var(--soft)}
.swatch{display:inline-block;width:24px;margin-right:7px;vertical-align:middle;border-top:3px solid var(--after)}
.swatch.before{border-top:3px dashed var(--before)}
.swatch.ahead{border-top:3px dotted var(--ink)}
.swatch.measured{border-top:7px solid var(--measured)}
.swatch.start{width:11px;height:11px;border:1.5px solid var(--ink);border-radius:99px}
.swatch.noise{border-top:3px dotted var(--floor)}
.swatch.kept{height:12px;border:0;background:var(--band)}
.swatch.framed{height:12px;border:1px dashed var(--soft);background:var(--band)}
.held{fill:var(--band);fill-opacity:.55}
.ramp{display:inline-flex;gap:0;vertical-align:middle;border:1px solid var(--soft);border-radius:3px;overflow:hidden}
.ramp .step{display:block;width:16px;height:11px}
.read{margin:10px 0 2px;font-variant-numeric:tabular-nums;font-weight:550;min-height:3em}
@media (min-width:760px){.read{min-height:0}}
input[type=range]{display:block;width:100%;height:28px;margin:0;accent-color:var(--after)}
#strip{height:104px;cursor:pointer;overflow:visible}
#strip .line{vector-effect:non-scaling-stroke}
.now{stroke:var(--ink);stroke-width:1.5;vector-effect:non-scaling-stroke}
.ends{display:flex;justify-content:space-between;gap:12px;margin:2px 0 0;font-size:13px;color:var(--soft);font-variant-numeric:tabular-nums}
nav{display:flex;flex-wrap:wrap;gap:4px 18px;align-items:baseline;padding-top:18px;border-top:1px solid var(--rule);font-size:15px}
nav h2{margin:0 8px 0 0}
details{margin:0;padding:12px 0;border-top:1px solid var(--rule)}
nav+details{margin-top:14px}
summary{cursor:pointer}
summary h2{display:inline;font-size:18px}
details>:nth-child(2){margin-top:20px}
.found{margin:14px 0 0;padding:0;list-style:none}
.found li{margin:5px 0;overflow-wrap:anywhere}
.found .rivals{color:var(--soft)}
.words{margin:14px 0 0;max-width:62em}
.words dt{font-weight:650}
.words dd{margin:0 0 10px;color:var(--soft)}
figure{margin:0 0 22px}
figcaption{max-width:62em;margin-top:8px;font-size:15px;color:var(--soft)}
figcaption.before{margin:0 0 12px}
figcaption strong{color:var(--ink);font-weight:600}
figcaption.over{margin:0;padding:6px 0;font-weight:600;color:var(--ink)}
.line.slim{stroke-width:1.3}
.panels{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,430px),1fr));gap:14px 24px}
.panels.single{grid-template-columns:minmax(0,820px)}
.panels.small{grid-template-columns:repeat(auto-fill,minmax(270px,1fr))}
a.file{margin-left:8px;font-size:13.5px;font-weight:400}
.weighed{display:grid;grid-auto-flow:row dense;grid-template-columns:auto minmax(60px,1fr) auto;gap:5px 12px;align-items:center;max-width:820px;font-size:15px}
.weighed span{overflow-wrap:anywhere}
.weighed .solid{font-weight:650}
.weighed .name{grid-column:1}
.weighed .length{grid-column:2}
.weighed .value{grid-column:3;font-variant-numeric:tabular-nums}
.length{position:relative;height:15px}
.length i,.length b{position:absolute;top:0;height:15px;border:1.5px solid var(--after);border-radius:2px}
.length i.hollow{border-color:var(--soft)}
.length i.solid{background:var(--after)}
.length i.hatched{background:repeating-linear-gradient(135deg,var(--after) 0 2px,transparent 2px 6px)}
.length b.zero{top:-3px;height:21px;width:0;border:0;border-left:1.5px solid var(--soft)}
svg{display:block;width:100%;height:auto;overflow:visible}
.map svg,svg svg{overflow:hidden}
.wide{overflow-x:auto}
table{border-collapse:collapse;min-width:min(100%,520px);font-size:15px;line-height:1.42}
th{font-weight:500;font-size:13.5px;color:var(--soft);text-align:left;vertical-align:bottom;border-bottom:1.5px solid var(--rule)}
td{vertical-align:top;border-bottom:1px solid var(--grid);overflow-wrap:break-word}
th,td{padding:6px 18px 6px 0}
td:first-child{white-space:nowrap}
th:last-child,td:last-child{padding-right:0}
.wide .number{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
.wide code{font-size:13.5px}
p.plain{max-width:62em}
ul.plain{padding-left:20px}
@media screen and (max-width:760px){
main{padding:22px 16px 48px}
.cards{grid-template-columns:minmax(0,1fr)}
section{margin-top:28px}
.panels{grid-template-columns:minmax(0,1fr)}
.wide{overflow:visible}
table,tbody,tr,td{display:block;min-width:0;width:100%}
thead{display:none}
tr{padding:8px 0;border-bottom:1.5px solid var(--rule)}
td{display:flex;flex-wrap:wrap;gap:2px 10px;justify-content:space-between;padding:2px 0;border:0;overflow-wrap:anywhere}
td:first-child{white-space:normal;font-weight:600}
td::before{content:attr(data-of);color:var(--soft);font-size:13.5px;font-weight:500;flex:none;max-width:100%}
td:empty{display:none}
td>div{flex:1 0 100%}
.wide .number{text-align:right;white-space:normal}
.panels text{font-size:17px}
.panels text.heading{font-size:19px}
.panels text.strong{font-size:15px}
.panels.small{grid-template-columns:repeat(2,minmax(0,1fr));gap:10px 12px}
.weighed{grid-template-columns:minmax(0,1fr) auto;gap:1px 12px;font-size:14px}
.weighed .value{grid-column:2}
.weighed .length{grid-column:1/-1;margin-bottom:8px}
.panels text.tick,.panels text.caption{font-size:16px}
}
@media print{
@page{margin:12mm}
body{font-size:9.5pt}
main{max-width:none;padding:0}
h1{font-size:17pt}
h2,summary h2{font-size:12.5pt}
main section,nav{margin-top:14px}
nav,.tools,input[type=range],.tabs,.copy,details:not([open]){display:none!important}
.texts{display:grid;grid-template-columns:1fr 1fr;gap:4px 12px}
.text{display:block!important;break-inside:avoid}
.text h3{display:block!important;margin:4px 0}
pre,code,.wide code{font-size:8pt}
h2,h3,.over,summary{break-after:avoid}
.card,tr,.next,.map,.panels,.weighed{break-inside:avoid}
.cards{grid-template-columns:1.5fr 1fr 1fr}
.card h2,.small,.bar,.legend,.read,figcaption,.ends{font-size:8.5pt}
.big{font-size:15pt}
.read{min-height:0}
.map svg{max-height:82mm}
#strip{height:70px}
.panels{grid-template-columns:1fr 1fr}
.panels.single{grid-template-columns:130mm}
.panels.small{grid-template-columns:1fr 1fr 1fr}
details{padding:6px 0}
details>:nth-child(2){margin-top:8px}
figure{margin-bottom:10px}
.wide{overflow:visible}
#gap .wide{display:inline-block;vertical-align:top;margin-right:8mm}
table{font-size:8.5pt;min-width:0}
th{font-size:8pt}
th,td{padding:3px 8px 3px 0}
*{-webkit-print-color-adjust:exact;print-color-adjust:exact}
}
";

/// The style sheet of the page and of the drawings on it.
pub fn page() -> String {
    let errors: String = theme::ERRORS
        .iter()
        .enumerate()
        .map(|(k, colour)| {
            let width = 3.5 + 0.9 * k as f64;
            format!(".error.e{k}{{stroke:{colour};stroke-width:{width:.1}}}\n.step.e{k}{{background:{colour}}}\n")
        })
        .collect();
    format!("{}{}", theme::drawing(), PAGE.replace("ERRORS", &errors))
}
