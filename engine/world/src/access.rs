//! What a system declares to read and to write, as tuples of components.

use crate::columns::Columns;
use crate::stores::Stored;
use crate::world::World;

/// Components that a system reads: a tuple of up to four.
pub trait ReadSet: 'static {
    /// Shared references to the columns.
    type Columns<'a>;
    /// One bit for each component.
    const BITS: u32;
    /// The columns.
    fn columns(world: &World) -> Self::Columns<'_>;
}

/// Components that a system writes: a tuple of up to four different ones.
pub trait WriteSet: 'static {
    /// The columns themselves.
    type Columns: Send;
    /// One bit for each component.
    const BITS: u32;
    /// Takes the columns out of a world, which is left with empty ones.
    fn take(world: &mut World) -> Self::Columns;
    /// Puts them back.
    fn put(columns: Self::Columns, world: &mut World);
}

macro_rules! sets {
    ($($component:ident $columns:ident),*) => {
        impl<$($component: Stored),*> ReadSet for ($($component,)*) {
            type Columns<'a> = ($(&'a Columns<$component>,)*);
            const BITS: u32 = 0 $(| 1 << $component::KIND as u32)*;
            fn columns(world: &World) -> Self::Columns<'_> {
                ($(world.columns::<$component>(),)*)
            }
        }

        impl<$($component: Stored),*> WriteSet for ($($component,)*) {
            type Columns = ($(Columns<$component>,)*);
            const BITS: u32 = {
                let bits = 0u32;
                $(
                    let bit = 1 << $component::KIND as u32;
                    assert!(bits & bit == 0, "a component is written twice");
                    let bits = bits | bit;
                )*
                bits
            };
            fn take(world: &mut World) -> Self::Columns {
                ($(world.take_columns::<$component>(),)*)
            }
            fn put(columns: Self::Columns, world: &mut World) {
                let ($($columns,)*) = columns;
                $(world.put_columns($columns);)*
            }
        }
    };
}

impl ReadSet for () {
    type Columns<'a> = ();
    const BITS: u32 = 0;
    fn columns(_: &World) {}
}

impl WriteSet for () {
    type Columns = ();
    const BITS: u32 = 0;
    fn take(_: &mut World) {}
    fn put((): (), _: &mut World) {}
}

sets!(A a);
sets!(A a, B b);
sets!(A a, B b, C c);
sets!(A a, B b, C c, D d);
