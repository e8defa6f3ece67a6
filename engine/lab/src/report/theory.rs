//! What a technique needs at least in memory a pixel, as the literature lays it out.
//!
//! A technique keeps B_depth bytes of depth and B_colour of light for each pixel, and beside them
//! what makes it: B_g of a G-buffer, B_l of a light buffer, B_index of light numbers, B_id of a
//! visibility buffer. With one sample a pixel its targets take the sum. The layouts are those of the
//! papers named with each; a pipeline that keeps more, for more precision or more kinds of surface,
//! has more.

use super::model::{Comparison, PipelineResult};

/// A part of the sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// Its symbol.
    pub symbol: &'static str,
    /// Bytes of it for a pixel of its own picture.
    pub bytes: f64,
    /// Its pixels over those of the frame.
    pub share: f64,
    /// The layout.
    pub layout: &'static str,
}

/// What a technique needs.
#[derive(Clone, Debug, PartialEq)]
pub struct Theory {
    /// The parts.
    pub terms: Vec<Term>,
    /// Where the layout comes from.
    pub source: &'static str,
}

const DEPTH: Term = term("B_depth", 4.0, "24 bits of depth and 8 of stencil");
const COLOUR: Term = term("B_colour", 8.0, "RGBA, 16-bit float");
const G_BUFFER: Term = term("B_g", 16.0, "four targets of RGBA, 8 bits");
const THIN: Term = term("B_g", 4.0, "normal and specular power, RGBA, 8 bits");
const LIGHT: Term = term(
    "B_l",
    8.0,
    "diffuse and luminance of specular light, RGBA, 16-bit float",
);
const INDEX: Term = term("B_index", 4.0, "four light numbers of 8 bits");
const IDENTITY: Term = term("B_id", 4.0, "object and triangle, 32 bits");
const EDGES: Term = term(
    "B_dsf",
    4.0,
    "16-bit depth, 8-bit object and 8-bit normal group",
);

const fn term(symbol: &'static str, bytes: f64, layout: &'static str) -> Term {
    Term {
        symbol,
        bytes,
        share: 1.0,
        layout,
    }
}

/// At half the width and half the height of the frame.
const fn quarter(term: Term) -> Term {
    Term {
        share: 0.25,
        ..term
    }
}

/// The theory of a technique by the name of the pipeline that comes with Lightbench.
pub fn of(pipeline: &str) -> Option<Theory> {
    let (terms, source) = match pipeline {
        "forward_single_pass" | "forward_multi_pass" => {
            (vec![DEPTH, COLOUR], "no buffer but the frame's own")
        }
        "tiled_forward" | "clustered_forward" | "world_indexed_forward" => (
            vec![DEPTH, COLOUR],
            "lists of lights lie beside the frame, not in its pixels (Harada et al. 2012, Forward+: Bringing Deferred Lighting to the Next Level; Olsson et al. 2012, Clustered Deferred and Forward Shading)",
        ),
        "deferred_shading" | "tiled_deferred" | "clustered_deferred" => (
            vec![G_BUFFER, DEPTH, COLOUR],
            "Valient 2007, Deferred Rendering in Killzone 2, layout of the G-buffer",
        ),
        "deferred_lighting" => (
            vec![THIN, LIGHT, DEPTH, COLOUR],
            "Engel 2009, Designing a Renderer for Multiple Lights: The Light Pre-Pass Renderer, in ShaderX7",
        ),
        "inferred_lighting" => (
            vec![
                quarter(EDGES),
                quarter(THIN),
                quarter(DEPTH),
                quarter(LIGHT),
                DEPTH,
                COLOUR,
            ],
            "Kircher and Lawrance 2009, Inferred Lighting, with buffers of half the width and height",
        ),
        "light_indexed_forward" => (
            vec![INDEX, DEPTH, COLOUR],
            "Trebilco 2009, Light Indexed Deferred Rendering, in ShaderX7",
        ),
        "light_indexed_deferred" => (
            vec![INDEX, G_BUFFER, DEPTH, COLOUR],
            "Trebilco 2009, Light Indexed Deferred Rendering, in ShaderX7, over the G-buffer of Valient 2007",
        ),
        "visibility_buffer" => (
            vec![IDENTITY, DEPTH, COLOUR],
            "Burns and Hunt 2013, The Visibility Buffer, JCGT 2 (2)",
        ),
        _ => return None,
    };
    Some(Theory { terms, source })
}

impl Theory {
    /// The sum, in bytes for a pixel of the frame.
    pub fn bytes_a_pixel(&self) -> f64 {
        self.terms.iter().map(|t| t.bytes * t.share).sum()
    }

    /// The sum with its symbols and numbers.
    pub fn formula(&self) -> String {
        let parts: Vec<String> = self
            .terms
            .iter()
            .map(|t| match t.share {
                1.0 => format!("{} {}", t.symbol, t.bytes),
                share => format!("{} {} × {share}", t.symbol, t.bytes),
            })
            .collect();
        parts.join(" + ")
    }

    /// The layouts behind the numbers.
    pub fn layouts(&self) -> String {
        let mut parts: Vec<String> = Vec::new();
        for t in &self.terms {
            let part = format!("{}: {}", t.symbol, t.layout);
            if !parts.contains(&part) {
                parts.push(part);
            }
        }
        parts.join("; ")
    }
}

/// Bytes of all targets of a pipeline for a pixel of the frame.
pub fn measured(p: &PipelineResult, c: &Comparison) -> f64 {
    let bytes: u64 = p.targets.iter().map(|t| t.bytes).sum();
    bytes as f64 / (f64::from(c.size[0]) * f64::from(c.size[1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_by_hand() {
        let sum = |name: &str| of(name).map(|t| t.bytes_a_pixel());
        assert_eq!(sum("forward_single_pass"), Some(12.0));
        // Four targets of four bytes, depth, and light: 16 + 4 + 8.
        assert_eq!(sum("tiled_deferred"), Some(28.0));
        assert_eq!(sum("deferred_lighting"), Some(24.0));
        // (4 + 4 + 4 + 8) / 4 + 12.
        assert_eq!(sum("inferred_lighting"), Some(17.0));
        assert_eq!(sum("mine"), None);
        let formula = of("visibility_buffer").map(|t| t.formula());
        assert_eq!(formula.as_deref(), Some("B_id 4 + B_depth 4 + B_colour 8"));
    }
}
