//! Pictures made of pixels.

use super::ink::Colour;
use super::view::Window;

/// 400 dots per inch, in dots per metre.
const DENSITY: u32 = 15_748;

/// A picture made of pixels, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Raster {
    width: usize,
    pixels: Vec<Colour>,
}

impl Raster {
    /// A picture from its pixels; an incomplete last row is left out.
    pub fn new(width: usize, pixels: impl IntoIterator<Item = Colour>) -> Self {
        let width = width.max(1);
        let mut pixels: Vec<_> = pixels.into_iter().collect();
        pixels.truncate(pixels.len() / width * width);
        Self { width, pixels }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.pixels.len() / self.width]
    }

    /// Draws a circle, smooth and two pixels wide, by its place in the window that the picture shows.
    pub fn ring(&mut self, center: [f64; 2], radius: f64, window: Window, colour: Colour) {
        let scale = self.width as f64 / window.size()[0];
        let (x, y, r) = ((center[0] - window.low[0]) * scale, (window.high[1] - center[1]) * scale, radius * scale);
        for (i, pixel) in self.pixels.iter_mut().enumerate() {
            let (column, row) = ((i % self.width) as f64 + 0.5, (i / self.width) as f64 + 0.5);
            let off = (libm::hypot(column - x, row - y) - r).abs();
            if off < 1.5 {
                *pixel = pixel.mix(colour, 1.5 - off);
            }
        }
    }

    /// The picture as a PNG file.
    pub fn png(&self) -> Vec<u8> {
        let [width, height] = self.size().map(|n| u32::try_from(n).unwrap_or(u32::MAX));
        let bytes: Vec<u8> = self.pixels.iter().flat_map(|c| [c.0, c.1, c.2]).collect();
        let mut png = Vec::new();
        let mut encoder = png::Encoder::new(&mut png, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: DENSITY, yppu: DENSITY, unit: png::Unit::Meter }));
        // Writing to memory fails only for a picture without pixels, which then is an empty file.
        let _ = encoder.write_header().and_then(|mut writer| {
            writer.write_image_data(&bytes)?;
            writer.finish()
        });
        png
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_png_reads_back_to_its_pixels() {
        let colours =
            [Colour(1, 2, 3), Colour::WHITE, Colour::BLACK, Colour(9, 8, 7), Colour(0, 0, 0), Colour(5, 5, 5)];
        let png = Raster::new(3, colours).png();
        let mut reader = png::Decoder::new(std::io::Cursor::new(&png)).read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        assert_eq!((info.width, info.height), (3, 2));
        assert_eq!(bytes, colours.iter().flat_map(|c| [c.0, c.1, c.2]).collect::<Vec<_>>());
    }
}
