//! `creepage figures`

use super::output::print;
use super::progress::ProgressLine;
use clap::{Args, ValueEnum};
use creepage::Result;
use creepage::figures::{self, Options};
use creepage::files::write_all_or_nothing;
use std::path::PathBuf;

/// Redraw the paper's figures, and some beyond it, as SVG with their data as CSV
#[derive(Args)]
#[command(after_help = after_help())]
pub struct Arguments {
    /// Figures to draw; all when none is named
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// Folder for the files
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// What a drawing is written as, beside its data; pdf and png need a program built with `--features drawings`
    #[arg(long, value_enum, default_value_t = Form::Svg)]
    format: Form,
    /// Rotation creep of the schematic figures, within ±0.6 [default: each figure's own]
    #[arg(long, value_name = "E", allow_hyphen_values = true)]
    e_rc: Option<f64>,
    /// Traverse creep of the schematic figures, within ±0.6 [default: each figure's own]
    #[arg(long, value_name = "E", allow_hyphen_values = true)]
    e_tc: Option<f64>,
    /// What Fig. 7 takes "conservative" to mean: A, A_l, B, C1, C2, D or F
    #[arg(long, value_name = "NAME", default_value = "A")]
    reading: String,
}

/// What a drawing is written as.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Form {
    /// As it is drawn; browsers and LaTeX packages read it
    Svg,
    /// In its printed size, 85 mm wide
    Pdf,
    /// At 300 dpi
    Png,
}

/// A file of a figure, a drawing in the form asked for.
fn converted((name, text): (String, String), form: Form) -> Result<(String, Vec<u8>)> {
    match name.strip_suffix(".svg").filter(|_| form != Form::Svg) {
        Some(stem) => drawn_as(stem, &text, form),
        None => Ok((name, text.into_bytes())),
    }
}

#[cfg(feature = "drawings")]
fn drawn_as(stem: &str, svg: &str, form: Form) -> Result<(String, Vec<u8>)> {
    use creepage::picture::converted::{pdf, png};
    match form {
        Form::Png => Ok((format!("{stem}.png"), png(svg)?)),
        _ => Ok((format!("{stem}.pdf"), pdf(svg)?)),
    }
}

#[cfg(not(feature = "drawings"))]
fn drawn_as(_: &str, _: &str, _: Form) -> Result<(String, Vec<u8>)> {
    Err(creepage::Error::input("this program writes drawings as SVG alone")
        .help("build it with `cargo build --release --features drawings`"))
}

fn after_help() -> String {
    format!(
        "Figures:\n{}\n\n\
         Examples:\n  creepage figures --out figures\n  creepage figures fig7 --reading B --out figures\n  \
         creepage figures fig2 fig4 --e-rc=-0.2 --e-tc 0.1 --out figures\n  \
         creepage figures --format pdf --out figures\n\n\
         Every figure is NAME.svg with NAME.csv or NAME-*.csv beside it. A figure is 85 mm wide.",
        figures::list()
    )
}

/// Carries out the command.
pub fn run(arguments: &Arguments, quiet: bool) -> Result<()> {
    let options = Options::new(arguments.e_rc, arguments.e_tc, &arguments.reading)?;
    let progress = ProgressLine::new(quiet);
    let drawn = figures::draw(&arguments.names, &options, &|p| progress.hear(p))?;
    drop(progress);
    let files = drawn.iter().flat_map(|(figure, drawing)| drawing.files(figure.name));
    let files = files.map(|file| converted(file, arguments.format)).collect::<Result<Vec<(String, Vec<u8>)>>>()?;
    let bytes: Vec<(&str, &[u8])> = files.iter().map(|(name, text)| (name.as_str(), &text[..])).collect();
    write_all_or_nothing(&arguments.out, &bytes)?;
    if !quiet {
        let texts: Vec<&str> = drawn.iter().map(|(_, d)| d.text.as_str()).filter(|t| !t.is_empty()).collect();
        let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
        texts.iter().try_for_each(|text| print(&format!("{text}\n")))?;
        print(&format!("{} are in {}\n", names.join(", "), arguments.out.display()))?;
    }
    Ok(())
}
