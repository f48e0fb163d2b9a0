//! Files that appear whole or not at all, and together.

mod lock;

use std::ffi::{OsStr, OsString};
use std::fs::{self, File, TryLockError};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use lock::lock;

/// A long file is flushed to disk in portions of this many bytes, each while the next one is being written. Otherwise the disk idles
/// until the system's write cache is full, or the file is finished.
const PORTION: usize = 1 << 24;

/// Naming files takes milliseconds: who holds the lock of a folder for longer than this does something else.
const PATIENCE: Duration = Duration::from_secs(3);

/// The temporary files that exist.
static TEMPORARY: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn temporary_files() -> MutexGuard<'static, Vec<PathBuf>> {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends the program at once, whatever its threads do; nothing is left of unfinished files.
pub fn exit(status: i32) -> ! {
    // the lock is held to the end, so that no new file is begun
    let files = temporary_files();
    for file in &*files {
        // a file that has its own name by now is no longer there
        let _ = fs::remove_file(file);
    }
    std::process::exit(status)
}

/// A file written under a temporary name in the same folder; [`finish`](Self::finish) gives it its own.
///
/// Under its own name the file is always seen complete, and an earlier file of that name stays until then. Dropped unfinished, it
/// leaves nothing behind.
#[derive(Debug)]
pub struct WholeFile {
    path: PathBuf,
    /// `None` once it has its own name.
    temporary: Option<PathBuf>,
    /// `None` once all of it is written.
    file: Option<BufWriter<File>>,
    /// Holds the lock, by which other processes know that the file is being written, until the file has its own name.
    locked: File,
    /// Bytes of the current portion, and the thread that flushes portions, if there has been one.
    portion: usize,
    carrier: Option<Carrier>,
}

/// A thread that flushes to disk what has been written, whenever it is told to.
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
    /// The folder or the temporary file cannot be made, or the path does not name a file, or names a folder.
    pub fn create(path: &Path) -> io::Result<Self> {
        let name =
            path.file_name().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "not the name of a file"))?;
        let folder = folder_of(path);
        fs::create_dir_all(folder)?;
        // found only when it is to be replaced, it would cost all the work
        refuse_folder(path)?;
        sweep(folder);
        let (temporary, file) = temporary(folder, name)?;
        let mut whole =
            Self { path: path.into(), temporary: Some(temporary), file: None, locked: file, portion: 0, carrier: None };
        whole.file = Some(BufWriter::with_capacity(1 << 16, whole.locked.try_clone()?));
        Ok(whole)
    }

    /// Checks before the work whether a file can be made there, and leaves nothing behind.
    ///
    /// # Errors
    /// As [`create`](Self::create).
    pub fn probe(path: &Path) -> io::Result<()> {
        Self::create(path).map(drop)
    }

    /// A file with this content, to be finished together with others.
    ///
    /// # Errors
    /// It cannot be made or written.
    pub fn with(path: &Path, content: &[u8]) -> io::Result<Self> {
        let mut file = Self::create(path)?;
        file.write_all(content)?;
        Ok(file)
    }

    /// Flushes the files of one folder to disk and then gives them their names, in this order. If one cannot be written or named,
    /// nothing is left of any, and the earlier files are in their places.
    ///
    /// # Errors
    /// One cannot be written, or cannot replace the file of its name.
    pub fn finish(mut files: Vec<Self>) -> io::Result<()> {
        files.iter_mut().try_for_each(Self::settle)?;
        // so that files of several processes are not mixed
        let _locked = files.first().and_then(|file| lock(folder_of(&file.path), PATIENCE));
        // the list is locked to the end, so that the program is not ended between two names
        let mut temporary = temporary_files();
        let mut earlier = Vec::with_capacity(files.len());
        let named = files.iter_mut().try_for_each(|file| {
            earlier.push(file.rename(&mut temporary)?);
            Ok(())
        });
        for (file, earlier) in files.iter().zip(earlier) {
            let _ = match (&named, earlier) {
                (Ok(()), Some(earlier)) => fs::remove_file(earlier),
                (Ok(()), None) => Ok(()),
                (Err(_), Some(earlier)) => fs::rename(earlier, &file.path),
                (Err(_), None) => fs::remove_file(&file.path),
            };
        }
        // a file without its name is dropped, which takes it off the list
        drop(temporary);
        named
    }

    /// Flushes the file to disk.
    fn settle(&mut self) -> io::Result<()> {
        let Some(file) = self.file.take() else { return Ok(()) };
        let written = file.into_inner().map_err(io::IntoInnerError::into_error);
        let carried = self.carrier.take().map_or(Ok(()), Carrier::finish);
        written.and_then(|file| carried.and_then(|()| file.sync_all()))
    }

    /// Gives the file its own name, after which it is no longer temporary. Returns where the earlier file of that name is kept, if
    /// there was one.
    fn rename(&mut self, files: &mut Vec<PathBuf>) -> io::Result<Option<PathBuf>> {
        let Some(temporary) = &self.temporary else { return Ok(None) };
        refuse_folder(&self.path)?;
        let aside = temporary.with_extension(EARLIER);
        let misplaced = |error: io::Error| {
            let name = self.path.file_name().unwrap_or_default().display();
            io::Error::new(error.kind(), format!("{name} cannot be put in its place: {error}"))
        };
        // a second name, so that the file is there at every moment; where there are none, its only one
        let kept = match fs::hard_link(&self.path, &aside) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => fs::rename(&self.path, &aside),
            kept => kept,
        };
        let earlier = match kept {
            Ok(()) => Some(aside),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => return Err(misplaced(error)),
        };
        if let Err(error) = fs::rename(temporary, &self.path) {
            if let Some(earlier) = earlier {
                let _ = fs::rename(&earlier, &self.path);
                // of two names of one file that removes none
                let _ = fs::remove_file(&earlier);
            }
            return Err(misplaced(error));
        }
        forget(files, temporary);
        self.temporary = None;
        Ok(earlier)
    }

    fn inner(&mut self) -> io::Result<&mut BufWriter<File>> {
        self.file.as_mut().ok_or_else(|| io::Error::other("the file is finished"))
    }
}

/// Takes a temporary file that is gone off the list.
fn forget(files: &mut Vec<PathBuf>, temporary: &Path) {
    files.retain(|file| file != temporary);
}

/// The folder that a file is in.
pub(crate) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A folder is never replaced by a file.
fn refuse_folder(path: &Path) -> io::Result<()> {
    if path.is_dir() {
        let what = format!("{} is a folder, not a file", path.file_name().unwrap_or_default().display());
        return Err(io::Error::new(io::ErrorKind::IsADirectory, what));
    }
    Ok(())
}

/// The beginning of the names of hidden files for this name; a process number, a serial number, a dot and [`PARTIAL`] or
/// [`EARLIER`] follow.
fn hidden(name: &OsStr) -> OsString {
    let mut hidden = OsString::from(".");
    hidden.push(name);
    hidden.push(".");
    hidden
}

/// Ends the names of temporary files.
const PARTIAL: &str = "partial";
/// Ends the names under which earlier files are kept until all the files that replace them have their names.
const EARLIER: &str = "earlier";

/// The name of the file that a hidden file stands for, and the ending that says how.
fn shown(hidden: &str) -> Option<(&str, &'static str)> {
    let (rest, ending) = hidden.strip_prefix('.')?.rsplit_once('.')?;
    let (name, numbers) = rest.rsplit_once('.')?;
    let (process, number) = numbers.split_once('-')?;
    let _: (u32, u64) = (process.parse().ok()?, number.parse().ok()?);
    let ending = [PARTIAL, EARLIER].into_iter().find(|known| *known == ending)?;
    (!name.is_empty()).then_some((name, ending))
}

/// Removes what killed programs have left of files in a folder, or puts it back where the file itself is missing. Files that are still
/// being written are locked, and so is the folder while files are replaced; where there are no locks, all stays.
fn sweep(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let (left, hidden) = (entry.path(), entry.file_name());
        let Some((name, ending)) = hidden.to_str().and_then(shown) else { continue };
        if ending == PARTIAL
            && entry.file_type().is_ok_and(|kind| kind.is_file())
            && let Ok(file) = File::options().write(true).open(&left)
        {
            remove_abandoned(&left, &file);
        } else if ending == EARLIER
            && let Some(_locked) = lock(folder, Duration::ZERO)
        {
            let path = folder.join(name);
            let _ = if path.exists() { fs::remove_file(left) } else { fs::rename(left, path) };
        }
    }
}

/// Removes a temporary file, opened under this name, unless it is being written.
fn remove_abandoned(left: &Path, file: &File) {
    // Since it was opened, it may have been removed, and another one begun under its name. Once it is locked, its name stays.
    if file.try_lock().is_ok() && is_named(file, left) {
        // a failure to remove it does not prevent writing
        let _ = fs::remove_file(left);
    }
}

/// Whether an open file still has this name.
#[cfg(unix)]
fn is_named(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |of: fs::Metadata| (of.dev(), of.ino());
    let [opened, named] = [file.metadata(), fs::symlink_metadata(path)].map(|of| of.ok().map(identity));
    opened.is_some() && opened == named
}

/// Whether an open file still has this name: unknown, but no process uses a name twice.
#[cfg(not(unix))]
fn is_named(_: &File, _: &Path) -> bool {
    true
}

/// Number of temporary files begun by this process, so that no two have the same name, not even one after the other.
static BEGUN: AtomicU64 = AtomicU64::new(0);

/// A new file that no other process writes. In containers that share a folder, processes may have the same number, and a killed
/// process leaves its file behind.
fn temporary(folder: &Path, name: &OsStr) -> io::Result<(PathBuf, File)> {
    let process = std::process::id();
    let mut files = temporary_files();
    loop {
        let number = BEGUN.fetch_add(1, Ordering::Relaxed);
        let mut hidden = hidden(name);
        hidden.push(format!("{process}-{number}.{PARTIAL}"));
        let path = folder.join(hidden);
        match File::create_new(&path) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            made => {
                let file = made?;
                // Another process that sweeps may have removed it before it was locked; without locks none does.
                if !matches!(file.try_lock(), Err(TryLockError::WouldBlock)) && path.exists() {
                    files.push(path.clone());
                    return Ok((path, file));
                }
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
            // a carrier that is still at work takes this portion with the next one; its error is reported at the end
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
            // Drops what is still in the buffer; there is nobody left to report an error to.
            let _ = file.into_parts();
            let _ = self.carrier.take().map(Carrier::finish);
        }
        if let Some(temporary) = self.temporary.take() {
            let _ = fs::remove_file(&temporary);
            forget(&mut temporary_files(), &temporary);
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
        WholeFile::finish(vec![WholeFile::with(&path, b"abc").unwrap()]).unwrap();
        let mut file = WholeFile::create(&path).unwrap();
        file.write_all(b"other").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"abc");
        WholeFile::finish(vec![file]).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"other");
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn two_that_write_one_file_do_not_tear_it() {
        let folder = std::env::temp_dir().join(format!("billiards-torn-{}", std::process::id()));
        let path = folder.join("x.txt");
        let [mut one, mut other] = [(); 2].map(|()| WholeFile::create(&path).unwrap());
        one.write_all(b"of the first").unwrap();
        other.write_all(b"other").unwrap();
        WholeFile::finish(vec![one]).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"of the first");
        WholeFile::finish(vec![other]).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"other");
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn files_appear_together_or_not_at_all() {
        let folder = std::env::temp_dir().join(format!("billiards-together-{}", std::process::id()));
        let [first, second] = ["a.txt", "b.txt"].map(|name| folder.join(name));
        let both = || [&first, &second].map(|path| WholeFile::with(path, b"new").unwrap()).into();
        WholeFile::finish(both()).unwrap();
        assert_eq!([&first, &second].map(|path| fs::read(path).unwrap()), [b"new", b"new"]);
        // the disk of this one is full
        let full = File::options().write(true).open("/dev/full");
        if let Ok(full) = full {
            fs::write(&first, b"old").unwrap();
            let mut files: Vec<WholeFile> = both();
            files[1].file = Some(BufWriter::new(full));
            files[1].write_all(b"lost").unwrap();
            assert_eq!(WholeFile::finish(files).unwrap_err().kind(), io::ErrorKind::StorageFull);
            assert_eq!(fs::read(&first).unwrap(), b"old");
        }
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 2);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn where_one_file_cannot_be_put_in_its_place_all_are_the_earlier_ones() {
        let folder = std::env::temp_dir().join(format!("billiards-back-{}", std::process::id()));
        let [none, old, blocked] = ["none.txt", "old.txt", "blocked.txt"].map(|name| folder.join(name));
        let new = || [&none, &old, &blocked].map(|path| WholeFile::with(path, b"new").unwrap()).into();
        let files: Vec<WholeFile> = new();
        fs::write(&old, b"old").unwrap();
        // since the files were begun
        fs::create_dir(&blocked).unwrap();
        fs::write(blocked.join("x"), b"kept").unwrap();
        let error = WholeFile::finish(files).unwrap_err();
        assert_eq!(error.to_string(), "blocked.txt is a folder, not a file");
        assert!(!none.exists());
        assert_eq!(fs::read(&old).unwrap(), b"old");
        assert_eq!(fs::read(blocked.join("x")).unwrap(), b"kept");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 2);
        fs::remove_dir_all(&blocked).unwrap();
        WholeFile::finish(new()).unwrap();
        assert_eq!([&none, &old, &blocked].map(|path| fs::read(path).unwrap()), [b"new"; 3]);
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 3);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn the_file_that_cannot_be_put_in_its_place_is_named_and_the_earlier_one_is_kept() {
        let folder = std::env::temp_dir().join(format!("billiards-refused-{}", std::process::id()));
        let [first, second] = ["a.txt", "b.txt"].map(|name| folder.join(name));
        fs::create_dir_all(&folder).unwrap();
        for path in [&first, &second] {
            fs::write(path, b"old").unwrap();
        }
        let files: Vec<WholeFile> = [&first, &second].map(|path| WholeFile::with(path, b"new").unwrap()).into();
        // its temporary file is gone
        fs::remove_file(files[1].temporary.as_ref().unwrap()).unwrap();
        let error = WholeFile::finish(files).unwrap_err();
        assert!(error.to_string().starts_with("b.txt cannot be put in its place: "), "{error}");
        assert_eq!([&first, &second].map(|path| fs::read(path).unwrap()), [b"old"; 2]);
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 2);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn an_earlier_file_that_a_killed_program_has_set_aside_is_put_back_where_it_is_missing() {
        let folder = std::env::temp_dir().join(format!("billiards-aside-{}", std::process::id()));
        let path = folder.join("x.txt");
        fs::create_dir_all(&folder).unwrap();
        let aside = |content: &str| fs::write(folder.join(".x.txt.4000000-0.earlier"), content).unwrap();
        aside("earlier");
        // while another process replaces files, they stay
        if let Some(locked) = lock(&folder, Duration::ZERO) {
            WholeFile::probe(&path).unwrap();
            assert!(!path.exists());
            drop(locked);
            WholeFile::probe(&path).unwrap();
            assert_eq!(fs::read(&path).unwrap(), b"earlier");
            aside("still earlier");
            WholeFile::probe(&path).unwrap();
            assert_eq!(fs::read(&path).unwrap(), b"earlier");
            assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        }
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn what_a_killed_program_has_left_is_removed_and_nothing_else() {
        let folder = std::env::temp_dir().join(format!("billiards-swept-{}", std::process::id()));
        let path = folder.join("x.txt");
        let written = WholeFile::with(&path, b"by another one").unwrap();
        let others = [".x.txt.partial", ".x.txt.1-2.part", ".x.txt.y-0.partial", "y.txt.1-0.partial"];
        // whatever the file was to be
        for name in others.iter().chain(&[".x.txt.4000000-0.partial", ".y.npy.4000000-0.partial"]) {
            fs::write(folder.join(name), b"left").unwrap();
        }
        WholeFile::probe(&path).unwrap();
        assert_eq!(others.map(|name| folder.join(name).exists()), [true; 4]);
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 5);
        WholeFile::finish(vec![written]).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"by another one");
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn no_temporary_name_is_used_twice() {
        let folder = std::env::temp_dir().join(format!("billiards-twice-{}", std::process::id()));
        let path = folder.join("x.txt");
        let name = || WholeFile::create(&path).unwrap().temporary.clone().unwrap();
        // each is gone before the next one is begun
        let names = [(); 3].map(|()| name());
        assert!(names[0] != names[1] && names[1] != names[2] && names[0] != names[2], "{names:?}");
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    #[cfg(unix)]
    fn a_file_begun_under_the_name_of_one_that_is_swept_stays() {
        let folder = std::env::temp_dir().join(format!("billiards-reused-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let left = folder.join(".x.txt.4000000-0.partial");
        fs::write(&left, b"probe").unwrap();
        let opened = File::options().write(true).open(&left).unwrap();
        fs::remove_file(&left).unwrap();
        fs::write(&left, b"record").unwrap();
        remove_abandoned(&left, &opened);
        assert_eq!(fs::read(&left).unwrap(), b"record");
        remove_abandoned(&left, &File::options().write(true).open(&left).unwrap());
        assert!(!left.exists());
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
