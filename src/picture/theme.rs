//! Colours, dashes and letters of every drawing, for light and dark screens and for print.
//!
//! The colours are Okabe and Ito's, told apart by colour-blind readers; dashes, widths and markers tell the same
//! things without any colour. The style sheets need no quotation marks and no comparison signs, so that they read the
//! same as HTML and as XML.

/// Colours of paper and ink, and of the things drawn, on a light ground.
const LIGHT: &str = "--paper:#ffffff;--panel:#f6f8fa;--ink:#1b1f24;--soft:#57606a;--rule:#d0d7de;--grid:#e8ecf0;\
--measured:#bcc4cd;--before:#d55e00;--after:#0072b2;--floor:#59636e;--band:#d3dae1;--good:#00694d;--warn:#a34700;";

/// The same on a dark ground.
const DARK: &str = "--paper:#0d1117;--panel:#161b22;--ink:#e6edf3;--soft:#a3adb8;--rule:#3d444d;--grid:#252c35;\
--measured:#5b6570;--before:#e69f00;--after:#56b4e9;--floor:#a3adb8;--band:#30373f;--good:#3fd0a4;--warn:#f0b040;";

const SHAPES: &str = "\
text{font:13px system-ui,-apple-system,Segoe UI,Roboto,Helvetica Neue,Arial,sans-serif;fill:var(--ink);paint-order:stroke;stroke:var(--paper);stroke-width:3px;stroke-linejoin:round}
text.tick,text.caption{font-size:12px;fill:var(--soft);font-variant-numeric:tabular-nums}
text.heading{font-weight:600;font-size:14px}
text.title{font-weight:650;font-size:19px}
text.strong{font-weight:600}
text.soft{fill:var(--soft)}
.paper{fill:var(--paper)}
.line.zero{stroke:var(--soft);stroke-width:1}
.grid{stroke:var(--grid);stroke-width:1}
.axis{stroke:var(--soft);stroke-width:1}
.leader{stroke:var(--rule);stroke-width:1}
.line{fill:none;stroke-linejoin:round;stroke-linecap:round;stroke-width:2}
.line.measured{stroke:var(--measured);stroke-width:7}
.line.before{stroke:var(--before);stroke-dasharray:6 4.5;stroke-linecap:butt}
.line.after{stroke:var(--after)}
.line.floor{stroke:var(--floor);stroke-dasharray:0.1 5;stroke-width:2.4}
.line.thin{stroke-width:1.1;stroke-dasharray:none}
.line.arrow{stroke:var(--ink);stroke-width:1.4}
.mark{stroke:var(--paper);stroke-width:1}
.mark.before{fill:var(--before)}
.mark.after{fill:var(--after)}
.mark.arrow{fill:var(--ink);stroke:none}
.mark.start{fill:var(--paper);stroke:var(--ink);stroke-width:1.3}
.band{fill:var(--band);stroke:none}
.bar{fill:var(--after);stroke:var(--after);stroke-width:1.2}
.bar.rival,.bar.other{fill:var(--paper)}
.bar.other{stroke:var(--soft)}
.hatch{stroke:var(--after);stroke-width:1.6;fill:none}
";

/// The style sheet of a drawing: variables for light and dark, and the look of every class.
pub fn drawing() -> String {
    format!("{}{SHAPES}", variables())
}

/// The variables alone; dark only on screens that ask for it, so that paper stays white.
pub fn variables() -> String {
    format!(
        ":root{{color-scheme:light dark;{LIGHT}}}\n\
         @media screen and (prefers-color-scheme:dark){{:root{{{DARK}}}}}\n\
         @media print{{:root{{color-scheme:light;{LIGHT}}}}}\n"
    )
}
