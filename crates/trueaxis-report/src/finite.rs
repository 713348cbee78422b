//! Numbers of an answer that are not finite: JSON has none, and serde writes `null` instead.

use serde::ser::{self, Serialize};
use std::fmt;

/// The place of the first number that is NaN or infinite, such as `scales.0.coefficient_um_per_m_k`.
///
/// ```
/// #[derive(serde::Serialize)]
/// struct Found { name: &'static str, mean_um: Vec<f64>, u_um: Option<f64> }
/// let found = |mean_um| Found { name: "X", mean_um, u_um: None };
/// assert_eq!(trueaxis_report::first_not_finite(&found(vec![1.0, 2.0])), None);
/// assert_eq!(trueaxis_report::first_not_finite(&found(vec![1.0, f64::NAN])).unwrap(), "mean_um.1");
/// ```
pub fn first_not_finite(answer: &impl Serialize) -> Option<String> {
    let mut walk = Walk { path: Vec::new() };
    match answer.serialize(&mut walk) {
        Err(Stop::NotFinite) => Some(walk.path.join(".")),
        _ => None,
    }
}

/// Walks through an answer, without writing it.
struct Walk {
    path: Vec<String>,
}

/// Why the walk ended before the end of the answer.
#[derive(Debug)]
enum Stop {
    NotFinite,
    /// What `Serialize` itself says.
    Other,
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the walk ended")
    }
}

impl std::error::Error for Stop {}

impl ser::Error for Stop {
    fn custom<T: fmt::Display>(_: T) -> Self {
        Self::Other
    }
}

/// A list or an object in the walk; the next item has this number.
struct Inside<'w> {
    walk: &'w mut Walk,
    next: usize,
}

impl Inside<'_> {
    fn item<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Stop> {
        let name = self.next.to_string();
        self.next += 1;
        self.named(&name, value)
    }

    fn named<T: Serialize + ?Sized>(&mut self, name: &str, value: &T) -> Result<(), Stop> {
        self.walk.path.push(name.to_owned());
        value.serialize(&mut *self.walk)?;
        self.walk.path.pop();
        Ok(())
    }
}

/// Everything that holds no number of its own.
macro_rules! nothing {
    ($($method:ident: $kind:ty),*) => {
        $(fn $method(self, _: $kind) -> Result<(), Stop> {
            Ok(())
        })*
    };
}

impl<'w> ser::Serializer for &'w mut Walk {
    type Ok = ();
    type Error = Stop;
    type SerializeSeq = Inside<'w>;
    type SerializeTuple = Inside<'w>;
    type SerializeTupleStruct = Inside<'w>;
    type SerializeTupleVariant = Inside<'w>;
    type SerializeMap = Inside<'w>;
    type SerializeStruct = Inside<'w>;
    type SerializeStructVariant = Inside<'w>;

    nothing!(
        serialize_bool: bool, serialize_i8: i8, serialize_i16: i16, serialize_i32: i32, serialize_i64: i64,
        serialize_u8: u8, serialize_u16: u16, serialize_u32: u32, serialize_u64: u64, serialize_char: char,
        serialize_str: &str, serialize_bytes: &[u8], serialize_unit_struct: &'static str
    );

    fn serialize_f32(self, value: f32) -> Result<(), Stop> {
        self.serialize_f64(value.into())
    }

    fn serialize_f64(self, value: f64) -> Result<(), Stop> {
        if value.is_finite() { Ok(()) } else { Err(Stop::NotFinite) }
    }

    fn serialize_none(self) -> Result<(), Stop> {
        Ok(())
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), Stop> {
        value.serialize(self)
    }

    fn serialize_unit(self) -> Result<(), Stop> {
        Ok(())
    }

    fn serialize_unit_variant(self, _: &str, _: u32, _: &str) -> Result<(), Stop> {
        Ok(())
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        value: &T,
    ) -> Result<(), Stop> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        value: &T,
    ) -> Result<(), Stop> {
        Inside { walk: self, next: 0 }.named(variant, value)
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Inside<'w>, Stop> {
        Ok(Inside { walk: self, next: 0 })
    }

    fn serialize_tuple(self, _: usize) -> Result<Inside<'w>, Stop> {
        Ok(Inside { walk: self, next: 0 })
    }

    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<Inside<'w>, Stop> {
        Ok(Inside { walk: self, next: 0 })
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Inside<'w>, Stop> {
        Ok(Inside { walk: self, next: 0 })
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Inside<'w>, Stop> {
        Ok(Inside { walk: self, next: 0 })
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Inside<'w>, Stop> {
        Ok(Inside { walk: self, next: 0 })
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Inside<'w>, Stop> {
        Ok(Inside { walk: self, next: 0 })
    }
}

macro_rules! items {
    ($($kind:ident $method:ident),*) => {
        $(impl ser::$kind for Inside<'_> {
            type Ok = ();
            type Error = Stop;

            fn $method<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Stop> {
                self.item(value)
            }

            fn end(self) -> Result<(), Stop> {
                Ok(())
            }
        })*
    };
}

items!(
    SerializeSeq serialize_element, SerializeTuple serialize_element, SerializeTupleStruct serialize_field,
    SerializeTupleVariant serialize_field
);

macro_rules! fields {
    ($($kind:ident),*) => {
        $(impl ser::$kind for Inside<'_> {
            type Ok = ();
            type Error = Stop;

            fn serialize_field<T: Serialize + ?Sized>(
                &mut self,
                name: &'static str,
                value: &T,
            ) -> Result<(), Stop> {
                self.named(name, value)
            }

            fn end(self) -> Result<(), Stop> {
                Ok(())
            }
        })*
    };
}

fields!(SerializeStruct, SerializeStructVariant);

impl ser::SerializeMap for Inside<'_> {
    type Ok = ();
    type Error = Stop;

    // The keys of documents are texts: their places are counted.
    fn serialize_key<T: Serialize + ?Sized>(&mut self, _: &T) -> Result<(), Stop> {
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Stop> {
        self.item(value)
    }

    fn end(self) -> Result<(), Stop> {
        Ok(())
    }
}
