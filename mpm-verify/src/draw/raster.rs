//! Shapes as pixels.

use super::colour::{INK, Rgb, channels};
use super::font::Font;
use super::shape::{Frame, Point, Shape, layers};
use image::RgbImage;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Mask, Paint, Path, PathBuilder, Pixmap, Rect, Stroke,
    StrokeDash, Transform,
};
use ttf_parser::OutlineBuilder;

/// Pixels of an image for one of the picture, along each side.
pub(super) const FINE: u32 = 3;

/// The pixels of a picture at its size over `coarser`.
///
/// # Errors
/// A picture without area, or text that the font can't write.
pub(super) fn pixels(size: (u32, u32), shapes: &[Shape], coarser: u32) -> Result<RgbImage, String> {
    let (width, height) = (size.0 / coarser, size.1 / coarser);
    let mut pixmap = Pixmap::new(width, height).ok_or("a picture without area")?;
    pixmap.fill(Color::WHITE);
    let scale = 1.0 / coarser as f32;
    let mut painter = Painter {
        pixmap,
        mask: None,
        coarser,
        transform: Transform::from_scale(scale, scale),
    };
    for shape in shapes {
        painter.shape(shape)?;
    }
    let opaque = painter.pixmap.data().chunks_exact(4);
    let bytes = opaque.flat_map(|p| [p[0], p[1], p[2]]).collect();
    RgbImage::from_raw(width, height, bytes).ok_or_else(|| "a picture without area".to_owned())
}

struct Painter {
    pixmap: Pixmap,
    mask: Option<Mask>,
    coarser: u32,
    transform: Transform,
}

impl Painter {
    fn shape(&mut self, shape: &Shape) -> Result<(), String> {
        match shape {
            Shape::Area {
                corners,
                colour,
                opacity,
            } => {
                if let Some(path) = polyline(corners, true) {
                    self.fill(&path, *colour, *opacity);
                }
            }
            Shape::Line {
                points,
                width,
                colour,
                pattern,
            } => {
                let stroke = Stroke {
                    width: *width as f32,
                    line_cap: LineCap::Round,
                    line_join: LineJoin::Round,
                    dash: StrokeDash::new(pattern.iter().map(|v| *v as f32).collect(), 0.0),
                    ..Stroke::default()
                };
                if let Some(path) = polyline(points, false) {
                    let (paint, mask) = (paint(*colour, 1.0), self.mask.as_ref());
                    self.pixmap
                        .stroke_path(&path, &paint, &stroke, self.transform, mask);
                }
            }
            Shape::Mark {
                marker,
                at,
                colour,
                hollow,
            } => {
                let whole = self.transform;
                self.transform = whole.pre_translate(at.0 as f32, at.1 as f32);
                for layer in layers(*marker, *colour, *hollow) {
                    self.shape(&layer)?;
                }
                self.transform = whole;
            }
            Shape::Text {
                text,
                at,
                font,
                turned,
            } => {
                if let Some(path) = outlines(text, *at, *font, *turned)? {
                    self.fill(&path, INK, 1.0);
                }
            }
            Shape::Image { image, at } => self.image(image, *at),
            Shape::Clip(frame) => self.mask = frame.and_then(|frame| self.mask_of(frame)),
        }
        Ok(())
    }

    fn fill(&mut self, path: &Path, colour: Rgb, opacity: f64) {
        let (paint, rule) = (paint(colour, opacity), FillRule::Winding);
        self.pixmap
            .fill_path(path, &paint, rule, self.transform, self.mask.as_ref());
    }

    fn mask_of(&self, frame: Frame) -> Option<Mask> {
        let [left, top, right, bottom] = frame.map(|v| v as f32);
        let path = PathBuilder::from_rect(Rect::from_ltrb(left, top, right, bottom)?);
        let mut mask = Mask::new(self.pixmap.width(), self.pixmap.height())?;
        mask.fill_path(&path, FillRule::Winding, true, self.transform);
        Some(mask)
    }

    fn image(&mut self, image: &RgbImage, at: Point) {
        let image = averaged(image, FINE * self.coarser);
        let place = |v: f64| (v / f64::from(self.coarser)).round() as u32;
        let (left, top) = (place(at.0), place(at.1));
        let width = self.pixmap.width();
        let pixels = self.pixmap.data_mut();
        for (x, y, pixel) in image.enumerate_pixels() {
            let first = 4 * ((top + y) * width + left + x) as usize;
            if let Some(channels) = pixels.get_mut(first..first + 3) {
                channels.copy_from_slice(&pixel.0);
            }
        }
    }
}

fn paint(colour: Rgb, opacity: f64) -> Paint<'static> {
    let ([red, green, blue], mut paint) = (channels(colour), Paint::default());
    paint.set_color_rgba8(red, green, blue, (255.0 * opacity).round() as u8);
    paint
}

fn polyline(points: &[Point], closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (k, (x, y)) in points.iter().map(|p| (p.0 as f32, p.1 as f32)).enumerate() {
        match k {
            0 => path.move_to(x, y),
            _ => path.line_to(x, y),
        }
    }
    if closed {
        path.close();
    }
    path.finish()
}

/// The outlines of a line of text; none of blanks.
fn outlines(text: &str, at: Point, font: Font, turned: bool) -> Result<Option<Path>, String> {
    let face = font.face().ok_or("a font that can't be read")?;
    let unit = (font.size / f64::from(face.units_per_em())) as f32;
    let mut pen = Pen {
        path: PathBuilder::new(),
        origin: at,
        along: 0.0,
        unit,
        turned,
    };
    for c in text.chars() {
        let glyph = face.glyph_index(c);
        let glyph = glyph.ok_or_else(|| format!("no glyph of {c:?} in \"{text}\""))?;
        face.outline_glyph(glyph, &mut pen);
        pen.along += unit * f32::from(face.glyph_hor_advance(glyph).unwrap_or(0));
    }
    Ok(pen.path.finish())
}

/// Writes glyphs, whose y points up, along a line.
struct Pen {
    path: PathBuilder,
    origin: Point,
    along: f32,
    unit: f32,
    turned: bool,
}

impl Pen {
    fn place(&self, x: f32, y: f32) -> (f32, f32) {
        let (along, up) = (self.along + self.unit * x, self.unit * y);
        let (left, top) = (self.origin.0 as f32, self.origin.1 as f32);
        match self.turned {
            true => (left - up, top - along),
            false => (left + along, top - up),
        }
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.place(x1, y1), self.place(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2)) = (self.place(x1, y1), self.place(x2, y2));
        let (x, y) = self.place(x, y);
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

/// The means of squares of `side` pixels; what is left over at the right and below is dropped.
fn averaged(image: &RgbImage, side: u32) -> RgbImage {
    let mut means = RgbImage::new(image.width() / side, image.height() / side);
    if means.is_empty() {
        return means;
    }
    let (row, square) = (3 * image.width() as usize, 3 * side as usize);
    let mut sums = vec![0; 3 * means.width() as usize];
    let rows = image.chunks_exact(row * side as usize);
    for (mean, rows) in means.chunks_exact_mut(sums.len()).zip(rows) {
        sums.fill(side * side / 2);
        for line in rows.chunks_exact(row) {
            for (sums, pixels) in sums.chunks_exact_mut(3).zip(line.chunks_exact(square)) {
                for pixel in pixels.chunks_exact(3) {
                    for (sum, channel) in sums.iter_mut().zip(pixel) {
                        *sum += u32::from(*channel);
                    }
                }
            }
        }
        for (mean, sum) in mean.iter_mut().zip(&sums) {
            *mean = (sum / (side * side)) as u8;
        }
    }
    means
}

#[cfg(test)]
mod tests {
    use super::super::canvas::Canvas;
    use super::super::font::SMALL;
    use super::*;

    #[test]
    fn means_are_those_of_squares() {
        let value = |x: u32, y: u32, k: u32| ((x * 7919 + y * 104_729 + k * 31) % 256) as u8;
        let pixel = |x, y| image::Rgb([0, 1, 2].map(|k| value(x, y, k)));
        let over = RgbImage::from_fn(17, 13, pixel);
        let means = averaged(&over, 3);
        assert_eq!(means.dimensions(), (5, 4));
        let square = (6..9).flat_map(|x| (3..6).map(move |y| u32::from(value(x, y, 1))));
        let mean = (square.sum::<u32>() as f64 / 9.0).round();
        assert_eq!(f64::from(means.get_pixel(2, 1).0[1]), mean);
    }

    #[test]
    fn shapes_are_seen_where_they_are_clipped_to_and_text_needs_its_glyphs() {
        let mut canvas = Canvas::new((40.0, 20.0));
        canvas.clip(Some([10.0, 0.0, 20.0, 20.0]));
        canvas.rectangle([0.0, 5.0, 40.0, 15.0], 0x0072B2, 1.0);
        canvas.clip(None);
        let image = pixels(canvas.size, &canvas.shapes, 1).unwrap();
        let inked = image.pixels().filter(|p| p.0 == channels(0x0072B2)).count();
        assert_eq!(inked, 100);
        canvas.text("\u{4e2d}", (5.0, 5.0), SMALL, (0.0, 0.0), false);
        assert!(
            pixels(canvas.size, &canvas.shapes, 1)
                .unwrap_err()
                .contains("no glyph")
        );
    }
}
