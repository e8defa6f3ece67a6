//! Builds pipelines on a thread of its own, so that drawing never waits for a compiler.

use std::collections::{BTreeSet, HashMap, VecDeque};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use lightbench::assets::files::Files;
use lightbench::render::{Compiler, Pipeline, PipelineDesc, Problems, Variants, heap};
use lightbench::script::{Settings, load_pipeline};

use super::Wake;

/// Builds one pipeline with some values for its parameters.
#[derive(Clone, Debug)]
pub struct Request {
    /// Name or path of the pipeline.
    pub name: String,
    /// Values for its parameters.
    pub settings: Settings,
    /// The variants of meshes that it must be able to draw.
    pub variants: Variants,
    /// Grows with every request; the answer carries it.
    pub ticket: u64,
    /// Before all others, because somebody looks at it.
    pub urgent: bool,
}

/// What came of a request. Answers come in the order of the work, and each builds on those before
/// it, so none may be dropped.
#[derive(Debug)]
pub enum Built {
    /// The pipeline that was built last serves, with these values.
    Values(Box<PipelineDesc>),
    /// A new pipeline.
    Pipeline(Box<Pipeline>),
}

/// The answer to a [`Request`].
#[derive(Debug)]
pub struct Answer {
    /// As in the request.
    pub name: String,
    /// As in the request.
    pub ticket: u64,
    /// Settings that the pipeline no longer has or refuses, and that were left out.
    pub left_out: Vec<String>,
    /// The pipeline, or all its mistakes.
    pub result: Result<Built, Problems>,
    /// How long the worker took.
    pub took: Duration,
}

enum Order {
    Build(Request),
    Changed(Vec<String>),
}

/// The thread and the way to it. Dropping it waits for the pipeline at hand.
pub struct CompileWorker {
    orders: Option<Sender<Order>>,
    answers: Receiver<Answer>,
    thread: Option<JoinHandle<()>>,
}

impl CompileWorker {
    /// Starts the thread. `wake` is called after each answer.
    pub fn start(compiler: Compiler, files: Files, wake: Wake) -> Self {
        let (orders, inbox) = channel();
        let (outbox, answers) = channel();
        let mut worker = Worker {
            compiler,
            files,
            built: HashMap::new(),
            queue: VecDeque::new(),
        };
        let thread = std::thread::spawn(move || worker.run(&inbox, &outbox, &wake));
        Self {
            orders: Some(orders),
            answers,
            thread: Some(thread),
        }
    }

    /// Asks for a pipeline. A request that still waits for the same pipeline is replaced.
    pub fn build(&self, request: Request) {
        self.send(Order::Build(request));
    }

    /// Tells that files changed. What was compiled from them is forgotten.
    pub fn changed(&self, paths: Vec<String>) {
        self.send(Order::Changed(paths));
    }

    /// The next answer, without waiting.
    pub fn poll(&self) -> Option<Answer> {
        self.answers.try_recv().ok()
    }

    fn send(&self, order: Order) {
        if let Some(orders) = &self.orders
            && orders.send(order).is_err()
        {
            tracing::error!("the thread that compiles pipelines has ended");
        }
    }
}

impl Drop for CompileWorker {
    fn drop(&mut self) {
        self.orders = None;
        if let Some(thread) = self.thread.take()
            && thread.join().is_err()
        {
            tracing::error!("the thread that compiles pipelines panicked");
        }
    }
}

/// A pipeline that was built.
struct Known {
    desc: PipelineDesc,
    variants: Variants,
    files: BTreeSet<String>,
}

struct Worker {
    compiler: Compiler,
    files: Files,
    /// What the other side holds, as far as it is still true to the shaders.
    built: HashMap<String, Known>,
    queue: VecDeque<Request>,
}

impl Worker {
    fn run(&mut self, inbox: &Receiver<Order>, outbox: &Sender<Answer>, wake: &Wake) {
        loop {
            if self.queue.is_empty() {
                heap::give_back_holes();
                match inbox.recv() {
                    Ok(order) => self.take(order),
                    Err(_) => return,
                }
            }
            loop {
                match inbox.try_recv() {
                    Ok(order) => self.take(order),
                    Err(TryRecvError::Empty) => break,
                    Err(TryRecvError::Disconnected) => return,
                }
            }
            if let Some(request) = self.queue.pop_front() {
                if outbox.send(self.answer(request)).is_err() {
                    return;
                }
                wake();
            }
        }
    }

    fn take(&mut self, order: Order) {
        match order {
            Order::Build(request) => {
                self.queue.retain(|waiting| waiting.name != request.name);
                if request.urgent {
                    self.queue.push_front(request);
                } else {
                    self.queue.push_back(request);
                }
            }
            Order::Changed(paths) => {
                for path in &paths {
                    self.compiler.forget(path);
                    // What only scripts say is compared with what they say now.
                    let shader = path.starts_with("shaders/");
                    self.built
                        .retain(|_, known| !shader || !known.files.contains(path));
                }
            }
        }
    }

    fn answer(&mut self, request: Request) -> Answer {
        let started = Instant::now();
        let (loaded, left_out) = load(&self.files, &request.name, &request.settings);
        let result = loaded.and_then(|desc| self.build(&request, desc));
        Answer {
            name: request.name,
            ticket: request.ticket,
            left_out,
            result,
            took: started.elapsed(),
        }
    }

    fn build(&mut self, request: &Request, desc: PipelineDesc) -> Result<Built, Problems> {
        if let Some(known) = self.built.get(&request.name)
            && known.desc.same_structure(&desc)
            && request.variants.without(known.variants).is_empty()
        {
            return Ok(Built::Values(Box::new(desc)));
        }
        let pipeline = self
            .compiler
            .compile_for(&self.files, &desc, request.variants)?;
        let known = Known {
            desc,
            variants: request.variants,
            files: pipeline.files().clone(),
        };
        self.built.insert(request.name.clone(), known);
        Ok(Built::Pipeline(Box::new(pipeline)))
    }
}

/// Evaluates a pipeline's file. Where that fails, settings that the file does not declare or
/// refuses are left out: a file that was edited may have lost the parameter that somebody set.
fn load(
    files: &Files,
    name: &str,
    settings: &Settings,
) -> (Result<PipelineDesc, Problems>, Vec<String>) {
    let problems = match load_pipeline(files, name, settings) {
        Ok(desc) => return (Ok(desc), Vec::new()),
        Err(problems) => problems,
    };
    let mut kept = Settings::new();
    // A switch may declare further parameters, so what was accepted is tried again with it.
    while let Ok(desc) = load_pipeline(files, name, &kept) {
        let more = settings.iter().find(|(name, value)| {
            let parameter = desc.parameter(name);
            kept.get(name).is_none()
                && parameter.is_some_and(|p| p.parse(&value.to_string()).is_ok())
        });
        let Some((accepted, value)) = more else {
            let left_out = settings
                .iter()
                .map(|(name, _)| name)
                .filter(|name| kept.get(name).is_none())
                .map(str::to_owned)
                .collect();
            return (Ok(desc), left_out);
        };
        kept.set(accepted, value.clone());
    }
    (Err(problems), Vec::new())
}
