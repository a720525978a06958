//! Colours, dashes and letters of every drawing, for light and dark screens and for print.
//!
//! The colours are Okabe and Ito's, told apart by colour-blind readers; dashes, widths and markers tell the same
//! things without any colour. The style sheets need no quotation marks and no comparison signs, so that they read the
//! same as HTML and as XML.

/// Colours of paper and ink, and of the things drawn, on a light ground.
const LIGHT: &str = "--paper:#ffffff;--panel:#f6f8fa;--ink:#1b1f24;--soft:#57606a;--rule:#d0d7de;--grid:#e8ecf0;\
--measured:#7d8894;--before:#d55e00;--after:#0072b2;--floor:#59636e;--band:#d3dae1;--good:#00694d;--warn:#a34700;--bad:#b3261e;";

/// The same on a dark ground.
const DARK: &str = "--paper:#0d1117;--panel:#161b22;--ink:#e6edf3;--soft:#a3adb8;--rule:#3d444d;--grid:#252c35;\
--measured:#8b96a2;--before:#e69f00;--after:#56b4e9;--floor:#a3adb8;--band:#30373f;--good:#3fd0a4;--warn:#f0b040;--bad:#ff8a80;";

const SHAPES: &str = "\
text{font:13px system-ui,-apple-system,Segoe UI,Roboto,Helvetica Neue,Arial,sans-serif;fill:var(--ink)}
text.tick,text.caption{font-size:12px;fill:var(--soft);font-variant-numeric:tabular-nums}
text.heading{font-weight:600;font-size:14px}
text.title{font-weight:650;font-size:19px}
text.strong{font-weight:600}
text.soft,.remark{fill:var(--soft)}
.remark{font-weight:400}
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
";

/// Colours of errors from none to the largest, after the diverging scale RdYlBu of Brewer (2002); width tells the same.
pub const ERRORS: [&str; 6] = ["#4575b4", "#91bfdb", "#e0f3f8", "#fee090", "#fc8d59", "#d73027"];

/// The halo of letters on a page, which browsers show.
const HALO_ON_PAGE: &str = "text{paint-order:stroke;stroke:var(--paper);stroke-width:3px;stroke-linejoin:round}\n";
/// The halo of letters in a file of its own, an element behind each: see [`Element::haloed`](super::svg::Element::haloed).
const HALO: &str = "text.halo{stroke:var(--paper);stroke-width:3px;stroke-linejoin:round}\n";

/// The style sheet of drawings on a page: variables for light and dark, and the look of every class.
pub fn drawing() -> String {
    format!("{}{SHAPES}{HALO_ON_PAGE}", variables())
}

/// The style sheet of a drawing of a report in a file of its own.
pub fn stand_alone() -> String {
    written_out(&format!("{SHAPES}{HALO}"))
}

/// The letters of a stand-alone figure, sized for a column of 85 mm, where 12 pixels are 7.2 points.
const LETTERS: &str = "font-family:Helvetica Neue,Arial,Liberation Sans,DejaVu Sans,sans-serif;font-size:12px;";
/// The shapes of a stand-alone figure, without colours.
const FIGURE: &str = "\
text.heading{font-size:12.5px;font-weight:600}
text.strong{font-weight:600}
.remark{font-weight:400}
.small{font-size:9.3px}
.line{fill:none;stroke-width:1.5;stroke-linejoin:round;stroke-linecap:round}
.line.hair,.grid,.line.measure,.leader{stroke-width:.8}
.line.angle,.axis{stroke-width:1}
.line.help{stroke-width:1;stroke-dasharray:2 3}
.line.velocity,.line.force{stroke-width:2}
.line.bar{stroke-width:1}
.line.ideal{stroke-width:1.3;stroke-dasharray:9 3 1.5 3;stroke-linecap:butt}
.line.crept,.line.before{stroke-width:3.1;stroke-dasharray:6 3.5;stroke-linecap:butt}
.line.kept,.line.after{stroke-width:1.5}
.line.third{stroke-width:1.8;stroke-dasharray:2.5 2.5;stroke-linecap:butt}
.line.floor{stroke-width:2;stroke-dasharray:.1 4}
.line.measured{stroke-width:5}
.mark{stroke-width:1}
.mark.start,.mark.ideal{stroke-width:1.3}
.shape,.disk{stroke-width:1.2;stroke-linejoin:round}
.ghost{stroke-dasharray:4 3}
";

/// The colours of a stand-alone figure.
const COLOURS: &str = "\
text.tick,text.caption,text.soft,.remark{fill:var(--soft)}
text.velocity,text.kept{fill:var(--after)}
text.force,text.crept{fill:var(--before)}
.line{stroke:var(--ink)}
.line.hair,.line.help,.line.measure,.axis,.leader{stroke:var(--soft)}
.grid{stroke:var(--grid)}
.line.velocity,.line.kept,.line.after{stroke:var(--after)}
.line.force,.line.crept,.line.before{stroke:var(--before)}
.line.third{stroke:var(--good)}
.line.floor{stroke:var(--floor)}
.line.measured{stroke:var(--measured)}
.head,.dot{fill:var(--ink)}
.head.measure{fill:var(--soft)}
.head.velocity,.mark.kept,.mark.after{fill:var(--after)}
.head.force,.mark.crept,.mark.before{fill:var(--before)}
.mark.third{fill:var(--good)}
.mark{stroke:var(--paper)}
.mark.start,.mark.ideal{fill:var(--paper);stroke:var(--ink)}
.shape,.disk{fill:var(--panel);stroke:var(--ink)}
.shape.body{stroke:var(--soft)}
.shape.wheel{fill:var(--measured)}
.shape.steered{fill:var(--soft)}
.shape.patch,.band{fill:var(--band)}
.ghost,.shape.ghost{fill:none;stroke:var(--soft)}
";

/// The style sheet of a figure that stands in a file of its own.
///
/// Colours are written out and not named by variables, so that programs which know no variables (those that turn SVG
/// into PDF) show the figure in its light colours; they skip the media query.
pub fn figure() -> String {
    let coloured = written_out(&format!(".paper{{fill:var(--paper)}}\ntext{{fill:var(--ink)}}\n{HALO}{COLOURS}"));
    format!("text{{{LETTERS}}}\n{FIGURE}{coloured}")
}

/// A figure's file for a program whose halos would cover thin letters at a low resolution, as those of Typst's pictures do.
pub fn without_halo(svg: &str) -> String {
    svg.replace("text.halo{stroke:", "text.halo{display:none;stroke:")
}

/// A sheet with its colours in the place of their names, light ones first and dark ones for screens that ask for them.
fn written_out(css: &str) -> String {
    let coloured = |colours: &str| {
        let named = colours.split(';').filter_map(|c| c.split_once(':'));
        named.fold(css.to_string(), |css, (name, value)| css.replace(&format!("var({name})"), value))
    };
    format!("{}@media screen and (prefers-color-scheme:dark){{\n{}}}\n", coloured(LIGHT), coloured(DARK))
}

/// The variables alone; dark only on screens that ask for it, so that paper stays white.
pub fn variables() -> String {
    format!(
        ":root{{color-scheme:light dark;{LIGHT}}}\n\
         @media screen and (prefers-color-scheme:dark){{:root{{{DARK}}}}}\n\
         @media print{{:root{{color-scheme:light;{LIGHT}}}}}\n"
    )
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_colour_of_a_file_is_written_out() {
        for css in [super::figure(), super::stand_alone()] {
            assert!(!css.contains("var(") && !css.contains("paint-order"), "{css}");
            assert_eq!(css.matches('{').count(), css.matches('}').count());
        }
    }

    #[test]
    fn letters_without_halo_have_none() {
        let plain = super::without_halo(&super::figure());
        assert_eq!(plain.matches("text.halo{display:none;").count(), 2, "{plain}");
    }
}
