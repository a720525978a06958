//! The look of the page; no quotation marks and no comparison signs, so that nothing needs escaping.

use crate::picture::theme;

const PAGE: &str = "\
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,-apple-system,Segoe UI,Roboto,Helvetica Neue,Arial,sans-serif}
main{max-width:1120px;margin:0 auto;padding:40px 28px 64px}
.eyebrow{margin:0 0 14px;color:var(--soft);font-size:14px}
.verdict{display:inline-block;margin-right:10px;padding:2px 10px;border:1.5px solid currentColor;border-radius:99px;font-weight:650;color:var(--warn)}
.verdict.good{color:var(--good)}
h1{margin:0;max-width:34em;font-size:clamp(23px,3.1vw,34px);line-height:1.22;font-weight:650;letter-spacing:-.012em;text-wrap:balance;overflow-wrap:anywhere}
.whole{white-space:nowrap}
h2{margin:56px 0 18px;padding-top:18px;border-top:1px solid var(--rule);font-size:22px;line-height:1.3;font-weight:650}
.headline{display:flex;flex-wrap:wrap;align-items:flex-end;gap:10px 40px;margin:26px 0 0}
.headline dl{display:flex;flex-direction:column-reverse;margin:0}
.headline dt{font-size:14px;color:var(--soft)}
.headline dd{margin:0;font-size:clamp(26px,3.6vw,40px);line-height:1.15;font-weight:650;font-variant-numeric:tabular-nums;letter-spacing:-.015em;white-space:nowrap}
.headline .minor dd{font-size:clamp(20px,2.4vw,26px);font-weight:500;color:var(--soft)}
.found{margin:22px 0 0;padding:0;list-style:none}
.found li{margin:5px 0;overflow-wrap:anywhere}
.found .rivals{color:var(--soft)}
code{font:14px/1.5 ui-monospace,SFMono-Regular,Menlo,Consolas,Liberation Mono,monospace;overflow-wrap:anywhere}
.numbered{margin:34px 0 0}
.numbered .number{margin:0 0 6px;font-size:13px;font-weight:650;color:var(--soft)}
figure{margin:0}
figcaption{max-width:62em;margin-top:8px;font-size:15px;color:var(--soft)}
figcaption strong{color:var(--ink);font-weight:600}
.panels{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,430px),1fr));gap:14px 24px}
.panels.single{grid-template-columns:minmax(0,820px)}
svg{display:block;width:100%;height:auto;overflow:visible}
svg svg{overflow:hidden}
.key{max-width:var(--key);margin-bottom:8px}
.next{margin:34px 0 0;padding:16px 20px;border-left:5px solid var(--after);background:var(--panel)}
.next p{margin:4px 0 0}
.next strong{font-weight:650}
.wide{overflow-x:auto;margin:0 0 26px}
table{border-collapse:collapse;min-width:min(100%,520px);font-size:15px;line-height:1.42}
caption{text-align:left;font-weight:600;padding:6px 0}
th{font-weight:500;font-size:13.5px;color:var(--soft);text-align:left;vertical-align:bottom;border-bottom:1.5px solid var(--rule)}
td{vertical-align:top;border-bottom:1px solid var(--grid);overflow-wrap:break-word}
th,td{padding:6px 18px 6px 0}
td:first-child{white-space:nowrap}
th:last-child,td:last-child{padding-right:0}
.wide .number{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
.wide code{font-size:13.5px}
p.plain{max-width:62em}
ul.plain{padding-left:20px}
@media (max-width:640px){main{padding:24px 16px 48px}h2{margin-top:40px}th,td{padding-right:12px}}
@media print{
@page{margin:14mm}
body{font-size:10.5pt}
main{max-width:none;padding:0}
h2{margin-top:26px}
h2,caption,.number{break-after:avoid}
.numbered,tr,.next{break-inside:avoid}
.panels{grid-template-columns:1fr 1fr}
.panels.single{grid-template-columns:130mm}
.wide{overflow:visible}
table{font-size:9.5pt;break-inside:avoid}
th,td{padding-right:9px}
*{-webkit-print-color-adjust:exact;print-color-adjust:exact}
}
";

/// The style sheet of the page and of the drawings on it.
pub fn page() -> String {
    format!("{}{PAGE}", theme::drawing())
}
