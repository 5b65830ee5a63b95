//! The shape of an attribute: words, `key = value`, `key(items, …)`.

use proc_macro2::Span;
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Ident, LitInt, LitStr, Token, parenthesized};

/// One entry of an attribute.
pub struct Item {
    /// What it says: the key, the word or the text.
    pub word: String,
    /// Where it stands.
    pub span: Span,
    /// What follows it.
    pub rest: Rest,
}

/// What follows a word.
pub enum Rest {
    Nothing,
    Value(Box<Item>),
    Items(Items),
}

/// Entries between commas.
pub type Items = Vec<Item>;

impl Parse for Item {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        if input.peek(LitStr) {
            let text: LitStr = input.parse()?;
            return Ok(Self { word: text.value(), span: text.span(), rest: Rest::Nothing });
        }
        if input.peek(LitInt) {
            let number: LitInt = input.parse()?;
            return Ok(Self { word: number.base10_digits().to_owned(), span: number.span(), rest: Rest::Nothing });
        }
        let name = input.call(Ident::parse_any).map_err(|e| syn::Error::new(e.span(), "expected a name or a text"))?;
        let rest = if input.peek(Token![=]) {
            input.parse::<Token![=]>()?;
            Rest::Value(Box::new(input.parse()?))
        } else if input.peek(syn::token::Paren) {
            let inner;
            parenthesized!(inner in input);
            Rest::Items(items(&inner)?)
        } else {
            Rest::Nothing
        };
        Ok(Self { word: name.to_string(), span: name.span(), rest })
    }
}

/// Entries between commas, to the end.
pub fn items(input: ParseStream) -> syn::Result<Items> {
    Ok(Punctuated::<Item, Token![,]>::parse_terminated(input)?.into_iter().collect())
}
