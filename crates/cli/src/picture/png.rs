//! Pictures made of pixels.

use std::collections::{BTreeMap, BTreeSet};

use super::ink::Colour;
use super::view::Window;

/// 400 dots per inch, in dots per metre.
const DENSITY: u32 = 15_748;

/// Most colours of a palette.
const PALETTE: usize = 256;

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

    /// Draws an antialiased circle, two pixels wide, given in coordinates of the window that the picture shows.
    pub fn ring(&mut self, center: [f64; 2], radius: f64, window: Window, colour: Colour) {
        let scale = self.width as f64 / window.size()[0];
        let (x, y, r) = ((center[0] - window.low[0]) * scale, (window.high[1] - center[1]) * scale, radius * scale);
        let near = (r - 2.0).max(0.0) * (r - 2.0)..(r + 2.0) * (r + 2.0);
        for (row, pixels) in self.pixels.chunks_exact_mut(self.width).enumerate() {
            let dy = row as f64 + 0.5 - y;
            for (column, pixel) in pixels.iter_mut().enumerate() {
                let dx = column as f64 + 0.5 - x;
                if near.contains(&(dx * dx + dy * dy)) {
                    let off = (libm::hypot(dx, dy) - r).abs();
                    if off < 1.5 {
                        *pixel = pixel.mix(colour, 1.5 - off);
                    }
                }
            }
        }
    }

    /// How many pixels there are of each colour.
    fn colours(&self) -> BTreeMap<Colour, usize> {
        let mut counts = BTreeMap::new();
        for pixel in &self.pixels {
            *counts.entry(*pixel).or_default() += 1;
        }
        counts
    }

    /// Its colours, if a palette has room for them.
    fn few_colours(&self) -> Option<BTreeSet<Colour>> {
        let mut colours = BTreeSet::new();
        let few = self.pixels.iter().all(|pixel| {
            colours.insert(*pixel);
            colours.len() <= PALETTE
        });
        few.then_some(colours)
    }

    /// The picture reduced to at most 256 of its most frequent colours, for a file of a third of the size: every pixel
    /// takes the nearest of them.
    #[must_use]
    pub fn reduced(mut self) -> Self {
        let mut colours: Vec<_> = self.colours().into_iter().collect();
        if colours.len() > PALETTE {
            // Among equally frequent ones the order of the colours decides, so that the picture is the same every time.
            colours.sort_by_key(|(colour, count)| (std::cmp::Reverse(*count), *colour));
            let palette: Vec<Colour> = colours.iter().take(PALETTE).map(|c| c.0).collect();
            let nearest = |colour: Colour| palette.iter().copied().min_by_key(|known| known.distance(colour));
            let taken: BTreeMap<_, _> = colours.iter().filter_map(|(c, _)| Some((*c, nearest(*c)?))).collect();
            for pixel in &mut self.pixels {
                *pixel = taken.get(pixel).copied().unwrap_or(*pixel);
            }
        }
        self
    }

    /// The picture as a PNG file; one of few colours has a palette.
    pub fn png(&self) -> Vec<u8> {
        let [width, height] = self.size().map(|n| u32::try_from(n).unwrap_or(u32::MAX));
        let mut png = Vec::new();
        let mut encoder = png::Encoder::new(&mut png, width, height);
        encoder.set_compression(png::Compression::High);
        let bytes: Vec<u8> = if let Some(colours) = self.few_colours() {
            let places: BTreeMap<Colour, u8> = colours.into_iter().zip(0..=u8::MAX).collect();
            encoder.set_color(png::ColorType::Indexed);
            encoder.set_palette(places.keys().flat_map(|c| [c.0, c.1, c.2]).collect::<Vec<_>>());
            // Palette indices are only names, so their differences are meaningless.
            encoder.set_filter(png::Filter::NoFilter);
            self.pixels.iter().filter_map(|pixel| places.get(pixel).copied()).collect()
        } else {
            encoder.set_color(png::ColorType::Rgb);
            // Trying harder does not make the noise of very many points smaller, and curves only by a quarter, in half
            // a second.
            encoder.set_compression(png::Compression::Fast);
            self.pixels.iter().flat_map(|c| [c.0, c.1, c.2]).collect()
        };
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: DENSITY, yppu: DENSITY, unit: png::Unit::Meter }));
        // Writing to memory fails only for a picture without pixels, which then becomes an empty file.
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
        let (size, bytes) = read(&Raster::new(3, colours).png());
        assert_eq!((size, bytes), ([3, 2], bytes_of(&colours)));
        // and with more colours than a palette has
        let many: Vec<_> = (0..4).flat_map(|a| (0..=u8::MAX).map(move |b| Colour(b, a, 77))).collect();
        assert_eq!(read(&Raster::new(32, many.clone()).png()), ([32, 32], bytes_of(&many)));
    }

    #[test]
    fn a_reduced_picture_has_256_colours_and_keeps_the_frequent_ones() {
        let rare = (0..4).flat_map(|a| (0..250).map(move |b| Colour(b, a, 0)));
        let frequent = std::iter::repeat_n(Colour(200, 100, 50), 24);
        let picture = Raster::new(32, frequent.chain(rare)).reduced();
        assert_eq!(picture.colours().len(), 256);
        assert_eq!(picture.pixels[0], Colour(200, 100, 50));
    }

    fn read(png: &[u8]) -> ([u32; 2], Vec<u8>) {
        let mut decoder = png::Decoder::new(std::io::Cursor::new(png));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        ([info.width, info.height], bytes)
    }

    fn bytes_of(colours: &[Colour]) -> Vec<u8> {
        colours.iter().flat_map(|c| [c.0, c.1, c.2]).collect()
    }
}
