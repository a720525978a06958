//! Where in a source file a mutant can be switched: the expression, arm or body around what it replaces.

use proc_macro2::{LineColumn, Span};
use std::collections::HashMap;
use std::ops::Range;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

/// What a mutant is switched in; ranges are bytes of the file.
#[derive(Clone, Debug)]
pub enum Switch {
    /// The whole expression is written twice.
    Expression(Range<usize>),
    /// An arm: the end of its pattern and its guard.
    Arm(usize, Option<Range<usize>>),
    /// The inside of a body, and whether it returns `impl Iterator`.
    Body(Range<usize>, bool),
    /// An `&&` around a `let`: no other operator compiles there.
    LetChain,
    /// In a constant, where nothing can be switched at run time.
    Constant,
}

/// Genre, line and column (from 1) of what is replaced.
pub type Key = (&'static str, usize, usize);

/// All switches of a file.
pub fn find(text: &str) -> HashMap<Key, Switch> {
    let file = syn::parse_file(text).expect("a source file that parses");
    let mut finder = Finder { found: HashMap::new(), constant: 0 };
    finder.visit_file(&file);
    finder.found
}

struct Finder {
    found: HashMap<Key, Switch>,
    constant: usize,
}

fn range(span: Span) -> Range<usize> {
    span.byte_range()
}

fn has_let(e: &syn::Expr) -> bool {
    match e {
        syn::Expr::Let(_) => true,
        syn::Expr::Binary(b) => matches!(b.op, syn::BinOp::And(_)) && (has_let(&b.left) || has_let(&b.right)),
        _ => false,
    }
}

impl Finder {
    fn put(&mut self, genre: &'static str, at: LineColumn, switch: Switch) {
        let switch = if self.constant > 0 { Switch::Constant } else { switch };
        self.found.insert((genre, at.line, at.column + 1), switch);
    }

    fn body(&mut self, block: &syn::Block, output: &syn::ReturnType) {
        let Some(first) = block.stmts.first() else { return };
        let last = block.stmts.last().unwrap_or(first);
        let inside = range(block.brace_token.span.open()).end..range(last.span()).end;
        let iterates = matches!(output, syn::ReturnType::Type(_, t) if matches!(**t, syn::Type::ImplTrait(_)));
        self.put("FnValue", first.span().start(), Switch::Body(inside, iterates));
    }

    fn in_constant(&mut self, visit: impl FnOnce(&mut Self)) {
        self.constant += 1;
        visit(self);
        self.constant -= 1;
    }
}

impl<'ast> Visit<'ast> for Finder {
    fn visit_expr_binary(&mut self, e: &'ast syn::ExprBinary) {
        let switch = match has_let(&syn::Expr::Binary(e.clone())) {
            true => Switch::LetChain,
            false => Switch::Expression(range(e.span())),
        };
        self.put("BinaryOperator", e.op.span().start(), switch);
        visit::visit_expr_binary(self, e);
    }

    fn visit_expr_unary(&mut self, e: &'ast syn::ExprUnary) {
        self.put("UnaryOperator", e.op.span().start(), Switch::Expression(range(e.span())));
        visit::visit_expr_unary(self, e);
    }

    fn visit_arm(&mut self, arm: &'ast syn::Arm) {
        let guard = arm.guard.as_ref().map(|(_, g)| range(g.span()));
        self.put("MatchArm", arm.span().start(), Switch::Arm(range(arm.pat.span()).end, guard.clone()));
        if let (Some((_, g)), Some(guard)) = (&arm.guard, guard) {
            self.put("MatchArmGuard", g.span().start(), Switch::Expression(guard));
        }
        // Patterns hold no mutants.
        if let Some((_, g)) = &arm.guard {
            self.visit_expr(g);
        }
        self.visit_expr(&arm.body);
    }

    fn visit_expr_struct(&mut self, e: &'ast syn::ExprStruct) {
        for field in &e.fields {
            self.put("StructField", field.span().start(), Switch::Expression(range(e.span())));
        }
        visit::visit_expr_struct(self, e);
    }

    fn visit_item_fn(&mut self, f: &'ast syn::ItemFn) {
        self.body(&f.block, &f.sig.output);
        visit::visit_item_fn(self, f);
    }

    fn visit_impl_item_fn(&mut self, f: &'ast syn::ImplItemFn) {
        self.body(&f.block, &f.sig.output);
        visit::visit_impl_item_fn(self, f);
    }

    fn visit_trait_item_fn(&mut self, f: &'ast syn::TraitItemFn) {
        if let Some(block) = &f.default {
            self.body(block, &f.sig.output);
        }
        visit::visit_trait_item_fn(self, f);
    }

    fn visit_item_const(&mut self, i: &'ast syn::ItemConst) {
        self.in_constant(|s| visit::visit_item_const(s, i));
    }

    fn visit_impl_item_const(&mut self, i: &'ast syn::ImplItemConst) {
        self.in_constant(|s| visit::visit_impl_item_const(s, i));
    }

    fn visit_item_static(&mut self, i: &'ast syn::ItemStatic) {
        self.in_constant(|s| visit::visit_item_static(s, i));
    }

    fn visit_type(&mut self, t: &'ast syn::Type) {
        self.in_constant(|s| visit::visit_type(s, t));
    }

    fn visit_expr_repeat(&mut self, e: &'ast syn::ExprRepeat) {
        self.visit_expr(&e.expr);
        // `vec![x; n]` is a macro and not seen here: this length is a constant.
        self.in_constant(|s| s.visit_expr(&e.len));
    }
}
