//! The canvas as the backend that plotters draws charts and axes on.

use super::SOLID;
use super::canvas::Canvas;
use super::colour::{Rgb, channels};
use super::font::Font;
use super::shape::Point;
use plotters::coord::{CoordTranslate, Shift};
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, Rect};
use plotters::element::{CoordMapper, Drawable, PointCollection};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontDesc, FontFamily, RGBAColor, ShapeStyle, TextStyle};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontStyle, FontTransform,
};
use std::convert::Infallible;

/// Plotters counts in whole numbers, these to a pixel of the picture: as fine as what draws pixels, for up to 21 000 of
/// them along a side.
const UNITS: f64 = 1e5;

/// The picture, or a part of it, as plotters sees it.
pub(super) type Sheet<'c> = DrawingArea<&'c mut Canvas, Shift>;
/// Why plotters could not draw: the canvas itself never fails.
pub(super) type Failure = DrawingAreaErrorKind<Infallible>;
type Drawn = Result<(), DrawingErrorKind<Infallible>>;

/// A length in pixels of the picture, as plotters counts it.
pub(super) fn units(pixels: f64) -> i32 {
    (UNITS * pixels).round() as i32
}

/// A point of the picture as plotters places it.
pub(super) fn placed((x, y): Point) -> BackendCoord {
    (units(x), units(y))
}

/// What plotters has placed as a point of the picture.
pub(super) fn pixel((x, y): BackendCoord) -> Point {
    (f64::from(x) / UNITS, f64::from(y) / UNITS)
}

/// A colour, with the width of lines in pixels of the picture.
pub(super) fn line(colour: Rgb, width: f64) -> ShapeStyle {
    let [red, green, blue] = channels(colour);
    ShapeStyle {
        color: RGBAColor(red, green, blue, 1.0),
        filled: false,
        stroke_width: units(width).unsigned_abs(),
    }
}

/// A light shade of a colour.
pub(super) fn shade(colour: Rgb) -> ShapeStyle {
    let mut style = line(colour, 0.0).filled();
    style.color.3 = 0.12;
    style
}

/// A text's font, and which point of its lines (from a capital's height to the last baseline) lies where it is put.
pub(super) fn lettering(font: Font, across: HPos, down: VPos) -> TextStyle<'static> {
    TextStyle::from(font).pos(Pos::new(across, down))
}

impl From<Font> for FontDesc<'static> {
    fn from(font: Font) -> Self {
        let style = match font.bold {
            true => FontStyle::Bold,
            false => FontStyle::Normal,
        };
        Self::new(FontFamily::SansSerif, UNITS * font.size, style)
    }
}

/// What is drawn by the canvas's own means at points that plotters places. Unlike those of plotters' elements they stay
/// where they are beyond the area.
pub(super) struct Own<C, F> {
    points: Vec<C>,
    draw: F,
}

impl<C, F: Fn(&mut Canvas, &[Point])> Own<C, F> {
    pub(super) fn new(points: Vec<C>, draw: F) -> Self {
        Self { points, draw }
    }
}

/// Leaves points beyond an area where they are.
pub(super) struct Anywhere;

impl CoordMapper for Anywhere {
    type Output = Point;

    fn map<T: CoordTranslate>(coordinates: &T, point: &T::From, _: &Rect) -> Point {
        pixel(coordinates.translate(point))
    }
}

impl<'a, C, F> PointCollection<'a, C, Anywhere> for &'a Own<C, F> {
    type Point = &'a C;
    type IntoIter = &'a [C];

    fn point_iter(self) -> &'a [C] {
        &self.points
    }
}

impl<C, F: Fn(&mut Canvas, &[Point])> Drawable<&mut Canvas, Anywhere> for Own<C, F> {
    fn draw<I: Iterator<Item = Point>>(
        &self,
        points: I,
        canvas: &mut &mut Canvas,
        _: (u32, u32),
    ) -> Drawn {
        (self.draw)(canvas, &points.collect::<Vec<_>>());
        Ok(())
    }
}

impl DrawingBackend for &mut Canvas {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        let (width, height) = placed((f64::from(self.size.0), f64::from(self.size.1)));
        (width.unsigned_abs(), height.unsigned_abs())
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, at: BackendCoord, colour: BackendColor) -> Drawn {
        self.draw_rect(at, (at.0 + 1, at.1 + 1), &colour, true)
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
    ) -> Drawn {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        corner: BackendCoord,
        opposite: BackendCoord,
        style: &S,
        fill: bool,
    ) -> Drawn {
        let ((left, top), (right, bottom)) = (pixel(corner), pixel(opposite));
        let (colour, half) = ink(style);
        if fill {
            self.rectangle([left, top, right, bottom], colour, style.color().alpha);
            return Ok(());
        }
        let (above, below) = (top - half, bottom + half);
        for x in [left, right] {
            self.rectangle([x - half, above, x + half, below], colour, 1.0);
        }
        for y in [top, bottom] {
            self.rectangle([left - half, y - half, right + half, y + half], colour, 1.0);
        }
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Drawn {
        let points: Vec<Point> = path.into_iter().map(pixel).collect();
        let (colour, half) = ink(style);
        match points[..] {
            // Lines of axes and grids: rectangles are sharp, and SVG joins those of one colour.
            [(x, from), (there, to)] if x == there => {
                let (top, bottom) = (from.min(to), from.max(to));
                self.rectangle([x - half, top, x + half, bottom], colour, 1.0);
            }
            [(from, y), (to, there)] if y == there => {
                self.rectangle([from, y - half, to, y + half], colour, 1.0);
            }
            _ => self.stroke(&points, 2.0 * half, colour, SOLID),
        }
        Ok(())
    }

    fn draw_text<T: BackendTextStyle>(&mut self, text: &str, style: &T, at: BackendCoord) -> Drawn {
        let font = Font {
            size: style.size() / UNITS,
            bold: matches!(style.style(), FontStyle::Bold),
        };
        let anchor = style.anchor();
        let across = match anchor.h_pos {
            HPos::Left => 0.0,
            HPos::Center => 0.5,
            HPos::Right => 1.0,
        };
        let down = match anchor.v_pos {
            VPos::Top => 0.0,
            VPos::Center => 0.5,
            VPos::Bottom => 1.0,
        };
        let turned = matches!(style.transform(), FontTransform::Rotate270);
        self.text(text, pixel(at), font, (across, down), turned);
        Ok(())
    }
}

/// Colour and half the width of a line.
fn ink(style: &impl BackendStyle) -> (Rgb, f64) {
    let (red, green, blue) = style.color().rgb;
    let half = f64::from(style.stroke_width()) / UNITS / 2.0;
    (u32::from_be_bytes([0, red, green, blue]), half)
}
