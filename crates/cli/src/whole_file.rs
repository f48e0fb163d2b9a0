//! Files that appear whole or not at all.

use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

/// A long file is brought to disk in portions of so many bytes, each while the next one is written. Otherwise the disk idles
/// until the system has as much in memory as it likes, or the file is finished.
const PORTION: usize = 1 << 24;

/// The temporary files that there are.
static TEMPORARY: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn temporary_files() -> MutexGuard<'static, Vec<PathBuf>> {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends the program at once, whatever its threads do; of files that are not finished nothing is left.
pub fn exit(status: i32) -> ! {
    // held to the end: no file is begun any more
    let files = temporary_files();
    for file in &*files {
        // one that has its own name by now is not there
        let _ = fs::remove_file(file);
    }
    std::process::exit(status)
}

/// A file written under a temporary name in the same folder; [`finish`](Self::finish) gives it its own.
///
/// Whoever sees the file under its own name sees all of it, and an earlier file of that name stays until then. Dropped
/// unfinished, it leaves nothing behind.
#[derive(Debug)]
pub struct WholeFile {
    path: PathBuf,
    temporary: PathBuf,
    /// `None` once finished.
    file: Option<BufWriter<File>>,
    /// Bytes of the portion at hand, and what brings portions to disk if there has been one.
    portion: usize,
    carrier: Option<Carrier>,
}

/// A thread that brings to disk what has been written, whenever it is told to.
#[derive(Debug)]
struct Carrier {
    go: SyncSender<()>,
    thread: JoinHandle<io::Result<()>>,
}

impl Carrier {
    fn of(file: &File) -> io::Result<Self> {
        let file = file.try_clone()?;
        let (go, portions) = sync_channel(1);
        let thread = std::thread::spawn(move || portions.into_iter().try_for_each(|()| file.sync_data()));
        Ok(Carrier { go, thread })
    }

    /// Waits for the last portion.
    fn finish(self) -> io::Result<()> {
        drop(self.go);
        self.thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    }
}

impl WholeFile {
    /// Starts a file, and makes its folder if need be.
    ///
    /// # Errors
    /// The folder or the temporary file cannot be made, or the path names no file, or a folder.
    pub fn create(path: &Path) -> io::Result<Self> {
        let name =
            path.file_name().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "not the name of a file"))?;
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        fs::create_dir_all(folder)?;
        if path.is_dir() {
            // renaming would find it out after all the work
            let what = format!("{} is a folder, not a file", name.display());
            return Err(io::Error::new(io::ErrorKind::IsADirectory, what));
        }
        let (temporary, file) = temporary(folder, name)?;
        let file = BufWriter::with_capacity(1 << 16, file);
        Ok(Self { path: path.into(), temporary, file: Some(file), portion: 0, carrier: None })
    }

    /// Tells before the work whether a file can be made there, and leaves nothing behind.
    ///
    /// # Errors
    /// As [`create`](Self::create).
    pub fn probe(path: &Path) -> io::Result<()> {
        Self::create(path).map(drop)
    }

    /// Writes a whole file at once.
    ///
    /// # Errors
    /// It cannot be made or written.
    pub fn write(path: &Path, content: &[u8]) -> io::Result<()> {
        let mut file = Self::create(path)?;
        file.write_all(content)?;
        file.finish()
    }

    /// Brings the file to disk and gives it its name.
    ///
    /// # Errors
    /// It cannot be written or renamed.
    pub fn finish(mut self) -> io::Result<()> {
        if let Some(file) = self.file.take() {
            let written = file.into_inner().map_err(io::IntoInnerError::into_error);
            let carried = self.carrier.take().map_or(Ok(()), Carrier::finish);
            let written = written.and_then(|file| carried.and_then(|()| file.sync_all()));
            let done = written.and_then(|()| fs::rename(&self.temporary, &self.path));
            if done.is_err() {
                // The write's own error says more than that of cleaning up after it.
                let _ = fs::remove_file(&self.temporary);
            }
            self.forget();
            done?;
        }
        Ok(())
    }

    /// Takes the temporary file off the list: it is gone.
    fn forget(&self) {
        let mut files = temporary_files();
        // only one: where it has its own name by now, another file may already be begun under this one
        if let Some(at) = files.iter().position(|file| *file == self.temporary) {
            files.swap_remove(at);
        }
    }

    fn inner(&mut self) -> io::Result<&mut BufWriter<File>> {
        self.file.as_mut().ok_or_else(|| io::Error::other("the file is finished"))
    }
}

/// A new file that nobody else writes. In containers that share a folder processes may have the same number, and one that was killed
/// leaves its file behind.
fn temporary(folder: &Path, name: &OsStr) -> io::Result<(PathBuf, File)> {
    let process = std::process::id();
    let mut number = 0_u64;
    let mut files = temporary_files();
    loop {
        let mut hidden = OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{process}-{number}.partial"));
        let path = folder.join(hidden);
        match File::create_new(&path) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
            made => {
                let file = made?;
                files.push(path.clone());
                return Ok((path, file));
            }
        }
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.inner()?.write(bytes)?;
        self.portion += written;
        if self.portion >= PORTION {
            self.portion = 0;
            let carrier = match self.carrier.take() {
                Some(carrier) => carrier,
                None => Carrier::of(self.inner()?.get_ref())?,
            };
            // a carrier that is still at work takes this portion with the next one; its error is told at the end
            let _ = carrier.go.try_send(());
            self.carrier = Some(carrier);
        }
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner()?.flush()
    }
}

impl Seek for WholeFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.inner()?.seek(to)
    }
}

impl Drop for WholeFile {
    fn drop(&mut self) {
        if let Some(file) = self.file.take() {
            // Without writing what is still in the buffer; nobody is left to hear of an error.
            let _ = file.into_parts();
            let _ = self.carrier.take().map(Carrier::finish);
            let _ = fs::remove_file(&self.temporary);
            self.forget();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_appears_only_when_it_is_finished() {
        let folder = std::env::temp_dir().join(format!("billiards-whole-{}", std::process::id()));
        let path = folder.join("deep").join("x.txt");
        let mut file = WholeFile::create(&path).unwrap();
        file.write_all(b"abc").unwrap();
        assert!(!path.exists());
        drop(file);
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 0);
        WholeFile::write(&path, b"abc").unwrap();
        let mut file = WholeFile::create(&path).unwrap();
        file.write_all(b"other").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"abc");
        file.finish().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"other");
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn two_that_write_one_file_do_not_tear_it() {
        let folder = std::env::temp_dir().join(format!("billiards-torn-{}", std::process::id()));
        let path = folder.join("x.txt");
        // one that was killed leaves its part behind
        std::mem::forget(WholeFile::create(&path).unwrap());
        let [mut one, mut other] = [(); 2].map(|()| WholeFile::create(&path).unwrap());
        one.write_all(b"of the first").unwrap();
        other.write_all(b"other").unwrap();
        one.finish().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"of the first");
        other.finish().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"other");
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_folder_in_place_of_a_file_is_found_before_the_work() {
        let folder = std::env::temp_dir().join(format!("billiards-folder-{}", std::process::id()));
        let path = folder.join("x.txt");
        fs::create_dir_all(&path).unwrap();
        assert_eq!(WholeFile::probe(&path).unwrap_err().to_string(), "x.txt is a folder, not a file");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(folder).unwrap();
    }
}
