//! Pictures as PNG files: the marks of the SVG painted pixel by pixel, without a browser, with letters of a
//! font that is part of the program. The same picture gives the same bytes on every computer.

use std::sync::Arc;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{self, Options, Tree, fontdb::Database};

/// Letters as wide as those that [`lettering`](super::lettering) counts with.
const FONTS: [&[u8]; 2] = [
    include_bytes!("../../fonts/Arimo-Regular.ttf"),
    include_bytes!("../../fonts/Arimo-Bold.ttf"),
];
const FAMILY: &str = "Arimo";

/// Pixels of the largest picture: 400 MB of memory while it is painted. A larger one is drawn smaller.
const MOST_PIXELS: f64 = 1e8;

/// How large a picture becomes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Resolution {
    /// So many pixels for each of the SVG's.
    Scale(f64),
    /// So many pixels wide.
    Width(u32),
}

impl Resolution {
    /// Pixels for each of the SVG's, for a picture of that size.
    fn scale(self, width: f64, height: f64) -> f64 {
        let scale = match self {
            Self::Scale(scale) => scale,
            Self::Width(pixels) => f64::from(pixels) / width,
        };
        scale.min((MOST_PIXELS / (width * height)).sqrt())
    }
}

/// Paints pictures.
#[derive(Debug)]
pub struct Painter {
    options: Options<'static>,
}

impl Default for Painter {
    fn default() -> Self {
        let mut fonts = Database::new();
        for font in FONTS {
            fonts.load_font_data(font.to_vec());
        }
        // Whatever family a picture asks for last, `sans-serif`, is this one.
        fonts.set_sans_serif_family(FAMILY);
        Self {
            options: Options {
                font_family: FAMILY.to_owned(),
                fontdb: Arc::new(fonts),
                ..Options::default()
            },
        }
    }
}

impl Painter {
    /// The SVG file `svg` as a PNG file.
    pub fn paint(&self, svg: &str, resolution: Resolution) -> Result<Vec<u8>, PaintError> {
        let tree = Tree::from_str(svg, &self.options)?;
        let (width, height) = (tree.size().width(), tree.size().height());
        let scale = resolution.scale(f64::from(width), f64::from(height));
        let pixels = |length: f32| (f64::from(length) * scale).round().clamp(1.0, MOST_PIXELS);
        // Between 1 and 1e8.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let (across, down) = (pixels(width) as u32, pixels(height) as u32);
        let mut pixmap = Pixmap::new(across, down).ok_or(PaintError::Large { across, down })?;
        // Single precision is finer than any pixel.
        #[allow(clippy::cast_possible_truncation)]
        let scale = scale as f32;
        resvg::render(
            &tree,
            Transform::from_scale(scale, scale),
            &mut pixmap.as_mut(),
        );
        pixmap
            .encode_png()
            .map_err(|error| PaintError::Encode(error.to_string()))
    }
}

/// Why a picture could not be painted.
#[derive(Debug, thiserror::Error)]
pub enum PaintError {
    /// The picture is no SVG.
    #[error("the picture is no SVG")]
    Svg(#[from] usvg::Error),
    /// There is no memory for it.
    #[error("there is no room for {across} by {down} pixels")]
    Large {
        /// Width [pixels].
        across: u32,
        /// Height [pixels].
        down: u32,
    },
    /// The pixels cannot be packed.
    #[error("its pixels cannot be packed: {0}")]
    Encode(String),
}

#[cfg(test)]
mod tests {
    use super::*;

    fn painted(svg: &str, resolution: Resolution) -> Pixmap {
        let bytes = Painter::default().paint(svg, resolution).unwrap();
        Pixmap::decode_png(&bytes).unwrap()
    }

    fn page(marks: &str) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200\" height=\"40\" viewBox=\"0 0 200 40\">\
             <rect width=\"200\" height=\"40\" fill=\"#ffffff\"/>{marks}</svg>"
        )
    }

    /// Width of what is not white [px of the SVG].
    fn ink_width(pixmap: &Pixmap) -> f64 {
        let is_ink = |x: u32| (0..pixmap.height()).any(|y| pixmap.pixel(x, y).unwrap().red() < 200);
        let columns: Vec<u32> = (0..pixmap.width()).filter(|&x| is_ink(x)).collect();
        let (Some(first), Some(last)) = (columns.first(), columns.last()) else {
            return 0.0;
        };
        f64::from(last - first + 1) * 200.0 / f64::from(pixmap.width())
    }

    #[test]
    fn sizes_are_as_asked_for() {
        for (resolution, across, down) in [
            (Resolution::Scale(1.0), 200, 40),
            (Resolution::Scale(2.5), 500, 100),
            (Resolution::Width(333), 333, 67),
            (Resolution::Width(1), 1, 1),
        ] {
            let pixmap = painted(&page(""), resolution);
            assert_eq!((pixmap.width(), pixmap.height()), (across, down));
        }
        assert!((Resolution::Scale(1e9).scale(100.0, 100.0) - 100.0).abs() < 1e-9);
    }

    #[test]
    fn letters_are_about_as_wide_as_the_figures_take_them_for() {
        for text in [
            "obstacle_b + view",
            "error norm, log. [m]",
            "−0.1 × 10⁻⁴ µs",
        ] {
            for (weight, wider) in [("normal", 1.0), ("bold", super::super::lettering::BOLD)] {
                let mark = format!(
                    "<text x=\"4\" y=\"24\" font-size=\"16\" font-weight=\"{weight}\" \
                     font-family=\"Helvetica, sans-serif\">{text}</text>"
                );
                let width = ink_width(&painted(&page(&mark), Resolution::Scale(4.0)));
                let expected = super::super::lettering::width(text, 16.0) * wider;
                assert!(
                    width > 0.8 * expected && width < 1.03 * expected,
                    "{text}, {weight}: {width} for {expected}"
                );
            }
        }
    }

    #[test]
    fn signs_of_the_figures_are_in_the_font() {
        let missing = ink_of("\u{4e2d}");
        assert!(missing.iter().any(|&dark| dark), "a box");
        for sign in "⁰¹²³⁴⁵⁶⁷⁸⁹⁻−×µ°σΛ…–≤≥äéłЖ".chars() {
            let ink = ink_of(&sign.to_string());
            assert!(ink != missing && ink.iter().any(|&dark| dark), "{sign}");
        }
    }

    fn ink_of(text: &str) -> Vec<bool> {
        let mark = format!("<text x=\"4\" y=\"30\" font-size=\"30\">{text}</text>");
        let pixmap = painted(&page(&mark), Resolution::Scale(1.0));
        pixmap.pixels().iter().map(|it| it.red() < 128).collect()
    }

    #[test]
    fn what_is_no_svg_is_an_error() {
        let error = Painter::default().paint("<svg", Resolution::Scale(1.0));
        assert!(matches!(error, Err(PaintError::Svg(_))), "{error:?}");
    }
}
