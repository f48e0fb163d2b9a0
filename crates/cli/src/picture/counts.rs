//! Portraits as numbers: how many of their points there are in each cell of a grid, for densities and everything computed from them.

use super::cloud::Cloud;
use super::{File, Material, Needs, Picture};
use crate::npy;

/// The velocity portrait as numbers.
pub(super) const VELOCITIES: Picture = Picture {
    name: "velocity-counts",
    files: &["velocity-counts.npy"],
    needs: Needs::Velocities,
    draw: |material: &Material| file("velocity-counts.npy", material.velocities.as_ref()),
};

/// The phase portrait as numbers.
pub(super) const REDUCED: Picture = Picture {
    name: "phase-counts",
    files: &["phase-counts.npy"],
    needs: Needs::Reduced,
    draw: |material: &Material| file("phase-counts.npy", material.reduced.as_ref().map(super::Reduced::cloud)),
};

/// The counts of a portrait as an array, its first row at the bottom of the picture.
fn file(name: &str, cloud: Option<&Cloud>) -> Vec<File> {
    let Some(cloud) = cloud else { return Vec::new() };
    let grid = cloud.counts();
    let [width, height] = grid.size();
    let mut content = npy::header("'<i8'", &format!("({height}, {width})"));
    for row in grid.counts().chunks_exact(width).rev() {
        content.extend(row.iter().flat_map(|count| count.to_le_bytes()));
    }
    vec![File { name: name.into(), content }]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The shape of an array, and its elements.
    fn read(content: &[u8]) -> (String, Vec<u64>) {
        let data = 10 + usize::from(u16::from_le_bytes([content[8], content[9]]));
        assert_eq!(data % 64, 0);
        let header = std::str::from_utf8(&content[10..data]).unwrap();
        let shape = header.split("'shape': ").nth(1).unwrap().trim_end().trim_end_matches(", }");
        (shape.into(), content[data..].as_chunks().0.iter().map(|bytes| u64::from_le_bytes(*bytes)).collect())
    }

    #[test]
    fn counts_of_few_and_of_many_points_stand_row_by_row_from_the_bottom() {
        for times in [1, 20_001] {
            let mut cloud = crate::picture::velocities();
            (0..times).for_each(|orbit| cloud.add(orbit, [0.5, -0.25]));
            cloud.add(0, [-0.5, 0.75]);
            let files = (VELOCITIES.draw)(&Material { velocities: Some(cloud), ..Material::default() });
            let (shape, counts) = read(&files[0].content);
            assert_eq!((files[0].name.as_str(), shape.as_str()), ("velocity-counts.npy", "(1000, 1000)"));
            // the cells have a width of 2.12/1000, and the first one begins at −1.06
            let filled: Vec<_> = counts.iter().enumerate().filter(|of| *of.1 > 0).map(|(i, n)| (i, *n)).collect();
            assert_eq!(filled, [(382 * 1000 + 735, times), (853 * 1000 + 264, 1)]);
        }
    }
}
