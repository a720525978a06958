//! The layout of any message, by the definition that the bag carries.
//!
//! A number is named by the fields that lead to it, such as `twist.linear.x`; an element of a list by its place, as
//! `data[2]`, or by the frame that it is of, as `base_link.transform.translation.x`; a quaternion has its turn about z
//! beside its four numbers, as `base_link.transform.rotation.yaw`.

use super::cdr::{Cdr, Read};
use crate::files::log::quaternion::yaw;
use re_ros_msg::MessageSchema;
use re_ros_msg::message_spec::{ArraySize, BuiltInType, ComplexType, MessageSpecification, Type, message_package};

/// How a value stands in a message.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Form {
    /// A number: its bytes, and which numbers they are.
    Number(Number),
    /// A text.
    Text,
    /// Whole seconds and nanoseconds.
    Time,
    /// A message within a message; of a quaternion the turn is told too.
    Parts { parts: Vec<(String, Form)>, turns: bool },
    /// A list, of a length of its own where none is fixed.
    List { form: Box<Form>, length: Option<usize> },
}

/// The numbers that are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Number {
    /// With a sign, of so many bytes.
    Signed(usize),
    /// Without one.
    Unsigned(usize),
    /// Of four bytes.
    Single,
    /// Of eight bytes.
    Double,
}

/// Messages within messages are no deeper.
const DEEPEST: usize = 24;
/// The most fields of a definition, with those of the messages within it.
const MOST_FIELDS: usize = 5000;
/// The most elements of a list that are columns; a longer list of numbers is a picture or a scan.
const MOST_ELEMENTS: usize = 64;
/// The field that names the frame an element is of.
const FRAME: &str = "child_frame_id";

impl Form {
    /// By the text of a definition; none where there is none, or it cannot be told how long a field is.
    pub fn of(name: &str, definition: &str) -> Option<Self> {
        if definition.trim().is_empty() {
            return None;
        }
        let schema = MessageSchema::parse(name, definition).ok()?;
        let mut fields = MOST_FIELDS;
        message(&schema, &schema.spec, DEEPEST, &mut fields)
    }

    /// Whether one message may have other fields than the next.
    pub fn varies(&self) -> bool {
        match self {
            Self::Parts { parts, .. } => parts.iter().any(|(_, form)| form.varies()),
            Self::List { form, length } => length.is_none() || form.varies(),
            _ => false,
        }
    }

    /// All numbers of a message with their names.
    pub fn numbers(&self, message: &[u8]) -> Read<Vec<(String, f64)>> {
        let mut found = vec![];
        self.read(&mut Cdr::new(message)?, "", &mut found)?;
        Ok(found)
    }

    /// Reads on; tells the frame that a part is of.
    fn read(&self, cdr: &mut Cdr, name: &str, found: &mut Vec<(String, f64)>) -> Read<Option<String>> {
        let mut frame = None;
        match self {
            Self::Number(number) => found.push((name.into(), number.read(cdr)?)),
            Self::Text => return Ok(Some(cdr.text()?.to_string())),
            Self::Time => found.push((name.into(), cdr.stamp()?)),
            Self::Parts { parts, turns } => {
                let first = found.len();
                for (part, form) in parts {
                    let text = form.read(cdr, &joined(name, part), found)?;
                    frame = if part == FRAME { text } else { frame };
                }
                if let (true, [x, y, z, w]) = (*turns, &found[first..]) {
                    let turn = yaw([x.1, y.1, z.1, w.1]);
                    found.push((joined(name, "yaw"), turn));
                }
            }
            Self::List { form, length } => {
                let length = length.map_or_else(|| cdr.u32().map(|n| n as usize), Ok)?;
                match **form {
                    Self::Number(number) if length > MOST_ELEMENTS => cdr.skip(length, number.bytes())?,
                    _ => (0..length).try_for_each(|i| form.element(cdr, name, i, found))?,
                }
            }
        }
        Ok(frame)
    }

    /// An element of a list, by the name of its frame or by its place.
    fn element(&self, cdr: &mut Cdr, list: &str, place: usize, found: &mut Vec<(String, f64)>) -> Read<()> {
        let mut own = vec![];
        let frame = self.read(cdr, "", &mut own)?;
        let name = match (self, frame) {
            (Self::Parts { .. }, Some(frame)) => frame,
            _ => format!("{list}[{place}]"),
        };
        if place < MOST_ELEMENTS {
            found.extend(own.into_iter().map(|(field, value)| (joined(&name, &field), value)));
        }
        Ok(())
    }
}

impl Number {
    fn bytes(self) -> usize {
        match self {
            Self::Signed(bytes) | Self::Unsigned(bytes) => bytes,
            Self::Single => 4,
            Self::Double => 8,
        }
    }

    fn read(self, cdr: &mut Cdr) -> Read<f64> {
        match self {
            Self::Signed(bytes) => cdr.integer(bytes).map(|v| {
                let unused = 64 - 8 * bytes as u32;
                ((v << unused) as i64 >> unused) as f64
            }),
            Self::Unsigned(bytes) => cdr.integer(bytes).map(|v| v as f64),
            Self::Single => cdr.integer(4).map(|v| f64::from(f32::from_bits(v as u32))),
            Self::Double => cdr.f64(),
        }
    }
}

fn joined(name: &str, part: &str) -> String {
    match (name.is_empty(), part.is_empty()) {
        (true, _) => part.into(),
        (_, true) => name.into(),
        _ => format!("{name}.{part}"),
    }
}

/// The name of a type without the folder that it may have.
fn plain(name: &str) -> String {
    name.replace("/msg/", "/")
}

fn message(schema: &MessageSchema, of: &MessageSpecification, deep: usize, fields: &mut usize) -> Option<Form> {
    let deep = deep.checked_sub(1)?;
    let mut parts = vec![];
    for field in &of.fields {
        parts.push((field.name.clone(), form(schema, of, &field.ty, deep, fields)?));
    }
    if parts.is_empty() {
        // A message without fields has a byte.
        parts.push(("structure_needs_at_least_one_member".into(), Form::Number(Number::Unsigned(1))));
    }
    let turns = plain(&of.name) == "geometry_msgs/Quaternion";
    Some(Form::Parts { parts, turns })
}

fn form(
    schema: &MessageSchema,
    scope: &MessageSpecification,
    ty: &Type,
    deep: usize,
    fields: &mut usize,
) -> Option<Form> {
    *fields = fields.checked_sub(1)?;
    match ty {
        Type::BuiltIn(kind) => built_in(kind),
        Type::Array { size: ArraySize::Fixed(0), .. } => None,
        Type::Array { ty, size } => {
            let length = if let ArraySize::Fixed(length) = size { Some(*length) } else { None };
            Some(Form::List { form: Box::new(form(schema, scope, ty, deep, fields)?), length })
        }
        Type::Complex(kind) => {
            let name = match kind {
                ComplexType::Absolute { package, name } => plain(&format!("{package}/{name}")),
                ComplexType::Relative { name } if name == "Header" => "std_msgs/Header".into(),
                ComplexType::Relative { name } => format!("{}/{name}", message_package(&scope.name)?),
            };
            match name.as_str() {
                "builtin_interfaces/Time" | "builtin_interfaces/Duration" => Some(Form::Time),
                _ => message(schema, schema.dependencies.iter().find(|d| plain(&d.name) == name)?, deep, fields),
            }
        }
    }
}

fn built_in(kind: &BuiltInType) -> Option<Form> {
    use BuiltInType as B;
    Some(Form::Number(match kind {
        B::Bool | B::Byte | B::Char | B::UInt8 => Number::Unsigned(1),
        B::UInt16 => Number::Unsigned(2),
        B::UInt32 => Number::Unsigned(4),
        B::UInt64 => Number::Unsigned(8),
        B::Int8 => Number::Signed(1),
        B::Int16 => Number::Signed(2),
        B::Int32 => Number::Signed(4),
        B::Int64 => Number::Signed(8),
        B::Float32 => Number::Single,
        B::Float64 => Number::Double,
        B::String(_) => return Some(Form::Text),
        // How long a wide character is differs between middlewares.
        B::WString(_) => return None,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TF: &str = "geometry_msgs/TransformStamped[] transforms
================
MSG: geometry_msgs/TransformStamped
std_msgs/Header header
string child_frame_id # the frame that moves
Transform transform
================
MSG: geometry_msgs/Transform
Vector3 translation
Quaternion rotation
================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
================
MSG: geometry_msgs/Quaternion
float64 x 0
float64 y 0
float64 z 0
float64 w 1
================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
";

    /// Plain CDR, little endian.
    #[derive(Default)]
    struct Written(Vec<u8>);

    impl Written {
        fn put(mut self, bytes: &[u8]) -> Self {
            while !self.0.len().is_multiple_of(bytes.len().clamp(1, 8)) {
                self.0.push(0);
            }
            self.0.extend(bytes);
            self
        }

        fn int(self, value: i32) -> Self {
            self.put(&value.to_le_bytes())
        }

        fn text(self, text: &str) -> Self {
            let mut to = self.int(text.len() as i32 + 1);
            to.0.extend(text.bytes().chain([0]));
            to
        }

        fn doubles(self, values: &[f64]) -> Self {
            values.iter().fold(self, |to, v| to.put(&v.to_le_bytes()))
        }

        fn whole(self) -> Vec<u8> {
            [&[0, 1, 0, 0][..], &self.0].concat()
        }
    }

    #[test]
    fn poses_of_tf_are_told_by_their_frame() {
        let form = Form::of("tf2_msgs/msg/TFMessage", TF).unwrap();
        let (s, c) = 0.2f64.sin_cos();
        let one = |to: Written, frame: &str, x: f64| {
            let to = to.int(7).int(500_000_000).text("odom").text(frame);
            to.doubles(&[x, 2.0, 0.0]).doubles(&[0.0, 0.0, s, c])
        };
        let message = one(one(Written::default().int(2), "base_link", 1.5), "arm", 3.0).whole();
        let found = form.numbers(&message).unwrap();
        let value = |name: &str| found.iter().find(|(n, _)| n == name).map(|(_, v)| *v);
        assert_eq!(value("base_link.header.stamp"), Some(7.5));
        assert_eq!(value("base_link.transform.translation.x"), Some(1.5));
        assert_eq!(value("arm.transform.translation.x"), Some(3.0));
        assert!((value("base_link.transform.rotation.yaw").unwrap() - 0.4).abs() < 1e-12);
        assert!(form.varies() && found.len() == 18);
        let short = &message[..message.len() - 3];
        assert!(form.numbers(short).is_err());
        let many = Written::default().int(-1).whole();
        assert!(form.numbers(&many).is_err());
    }

    #[test]
    fn numbers_of_all_kinds_are_read() {
        let text = "bool on\nint16 a\nuint64 b\nfloat32 c\nint8[3] d\nfloat64[] e\nuint8[] image\nstring<=5 name\nint64 MOST=3\n";
        let form = Form::of("own/Wheels", text).unwrap();
        let message = Written::default()
            .put(&[1])
            .put(&(-2i16).to_le_bytes())
            .put(&9_000_000_000u64.to_le_bytes())
            .put(&1.5f32.to_le_bytes());
        let message = [255u8, 2, 128].iter().fold(message, |to, byte| to.put(&[*byte]));
        let mut message = message.int(2).doubles(&[0.25, -4.0]).int(100);
        message.0.extend([7; 100]);
        let found = form.numbers(&message.text("left").whole()).unwrap();
        let expected = [
            ("on", 1.0),
            ("a", -2.0),
            ("b", 9e9),
            ("c", 1.5),
            ("d[0]", -1.0),
            ("d[1]", 2.0),
            ("d[2]", -128.0),
            ("e[0]", 0.25),
            ("e[1]", -4.0),
        ];
        assert_eq!(found, expected.map(|(name, value)| (name.to_string(), value)));
    }

    #[test]
    fn what_cannot_be_told_is_not_guessed() {
        assert_eq!(Form::of("own/Wide", "wstring name\n"), None);
        assert_eq!(Form::of("own/Lost", "other/Thing thing\n"), None);
        let endless = "own/A a\n================\nMSG: own/A\nown/A a\n";
        assert_eq!(Form::of("own/Endless", endless), None);
        assert_eq!(Form::of("std_msgs/Empty", "\n"), None);
    }
}
